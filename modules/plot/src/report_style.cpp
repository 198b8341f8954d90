// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/plot/report_figure.h>

namespace fastlio
{
std::string reportStyle()
{
  return R"(:root{color-scheme:light dark;--paper:#ffffff;--card:#f6f7f9;--ink:#1b1f24;--soft:#5b6570;
--line:#d5dae0;--grid:#e3e7eb;--good:#1a7f4b;--warn:#b26a00;--bad:#c0322b;--path:#111418;--untrusted:#b5107d;
--s1:#1f6fc4;--s2:#c2410c;--s3:#15803d;--s4:#8e44ad;--s5:#b8860b;--s6:#0e8a92;
--c-none:#888888;--c-starting:#8a94a0;--c-lost:#c0322b;--c-no_match:#e2572b;--c-few_matches:#e09a1a;
--c-large_residual:#b03a8c;--c-degenerate_direction:#7a52c7;--c-inertial_data:#1d7fd1;
--c-bias:#0e9aa7;--c-scan_timing:#8d6e2f;--c-motion_disagreement:#4f8f2f}
@media (prefers-color-scheme:dark){:root{--paper:#14171a;--card:#1d2125;--ink:#e6e9ec;--soft:#9aa5b0;
--line:#3a424a;--grid:#2b3137;--good:#4cc38a;--warn:#f0b054;--bad:#ff7b72;--path:#ffffff;--untrusted:#ff6ec7;
--s1:#5fa8f5;--s2:#f59057;--s3:#57c785;--s4:#c79bea;--s5:#e3bf4f;--s6:#4cc4cc}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;padding:1rem;max-width:1560px;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;overflow-wrap:anywhere}
h1{font-size:1.5rem;line-height:1.25;margin:.2rem 0 .6rem}
h2{font-size:1.2rem;margin:2rem 0 .6rem;padding-bottom:.2rem;border-bottom:1px solid var(--line)}
h3{font-size:1rem;margin:1rem 0 .2rem}
p{margin:.4rem 0;max-width:70rem}
a{color:var(--s1)}
header{border-left:6px solid var(--soft);padding:.2rem 0 .2rem 1rem}
header.good{border-color:var(--good)}header.warn{border-color:var(--warn)}header.bad{border-color:var(--bad)}
.good h1{color:var(--good)}.warn h1{color:var(--warn)}.bad h1{color:var(--bad)}
.source,figure p,.note{color:var(--soft);font-size:.875rem}
.grid-of{display:grid;gap:1rem;align-items:start;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr))}
.grid-of>*{min-width:0}
figure{margin:0;padding:.7rem;background:var(--card);border:1px solid var(--line);border-radius:8px}
figcaption{display:flex;flex-wrap:wrap;gap:.1rem .9rem;font-size:.9rem}
.key{color:var(--soft);white-space:nowrap}
.key i{display:inline-block;width:.8em;height:.8em;border-radius:2px;margin-right:.3em}
svg{display:block;width:100%;height:auto;font:12px system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
svg text{fill:var(--ink)}
svg .grid{stroke:var(--grid)}svg .frame{stroke:var(--soft)}
table{border-collapse:collapse;min-width:min(100%,40rem);max-width:100%;font-size:.9rem}
th{overflow-wrap:break-word}
th,td{text-align:left;vertical-align:top;padding:.25rem .6rem .25rem 0;border-bottom:1px solid var(--line)}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.wide{overflow-x:auto}
details{margin:.5rem 0}summary{cursor:pointer}
code{font-size:.9em}
@media print{body{max-width:none}figure{break-inside:avoid}}
)";
}

}  // namespace fastlio
