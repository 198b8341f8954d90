// mrpt_fastlio: reads a LAS file with npm's copc.
// SPDX-License-Identifier: BSD-3-Clause
//
// Usage: node read_las.cjs FILE
// Prints the header, the reference system, and a line per point: x y z intensity return of returns class source time.
// FASTLIO_NODE_MODULES names the folder with copc.
const fs = require("fs");
const load = require("module").createRequire(process.env.FASTLIO_NODE_MODULES + "/");
const { Las } = load("copc");

async function main(file) {
  const bytes = fs.readFileSync(file);
  const header = Las.Header.parse(bytes);
  console.log("version", header.majorVersion + "." + header.minorVersion, "format", header.pointDataRecordFormat,
    "record", header.pointDataRecordLength, "encoding", header.globalEncoding);
  console.log("software", header.generatingSoftware);
  console.log("created", header.fileCreationDayOfYear, header.fileCreationYear);
  console.log("points", header.pointCount, "returns", header.pointCountByReturn.join(" "));
  console.log("scale", header.scale.join(" "), "offset", header.offset.join(" "));
  console.log("min", ...header.min.map((x) => x.toFixed(4)), "max", ...header.max.map((x) => x.toFixed(4)));
  const records = await Las.Vlr.walk(file, header);
  const system = Las.Vlr.find(records, "LASF_Projection", 2112);
  console.log("records", records.length);
  console.log("wkt", system ? Buffer.from(await Las.Vlr.fetch(file, system)).toString().replace(/\0$/, "") : "none");
  const view = Las.View.create(bytes.subarray(header.pointDataOffset), header);
  const names = ["X", "Y", "Z", "Intensity", "ReturnNumber", "NumberOfReturns", "Classification", "PointSourceId", "GpsTime"];
  const columns = names.map((name) => view.getter(name));
  for (let i = 0; i < view.pointCount; ++i)
    console.log(columns.map((column, at) => column(i).toFixed(at < 3 ? 4 : at === 8 ? 7 : 0)).join(" "));
}

main(process.argv[2]).catch((error) => { console.error(error); process.exit(1); });
