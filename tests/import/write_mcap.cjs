// mrpt_fastlio: writes MCAP with npm's @mcap/core, from the files of the conformance test.
// SPDX-License-Identifier: BSD-3-Clause
//
// Usage: node write_mcap.cjs DUMP OUT.mcap none|lz4|zstd
// DUMP is that of write_bag.py. FASTLIO_NODE_MODULES names the folder with @mcap/core,
// @foxglove/rosmsg2-serialization and @foxglove/rosmsg-msgs-common.
const childProcess = require("child_process");
const fs = require("fs");
const path = require("path");
const load = require("module").createRequire(process.env.FASTLIO_NODE_MODULES + "/");
const { McapWriter } = load("@mcap/core");
const { MessageWriter } = load("@foxglove/rosmsg2-serialization");
const definitions = load("@foxglove/rosmsg-msgs-common").ros2humble;

const POINT_BYTES = 22;

/** The definition of a type and of all that it is made of. */
function withParts(name, seen = new Map()) {
  if (seen.has(name)) return seen;
  const builtin = { "builtin_interfaces/Time": "time" };
  if (builtin[name]) return seen;
  seen.set(name, { name, definitions: definitions[name].definitions });
  for (const field of definitions[name].definitions)
    if (field.isComplex) withParts(field.type, seen);
  return seen;
}

function writerOf(name) {
  const all = [...withParts(name).values()];
  return new MessageWriter([{ name, definitions: all[0].definitions }, ...all.slice(1)]);
}

const stampOf = (ns) => ({ sec: Number(ns / 1000000000n), nsec: Number(ns % 1000000000n), nanosec: Number(ns % 1000000000n) });

function* imuMessages(file) {
  for (const line of fs.readFileSync(file, "utf8").trim().split("\n")) {
    const [stamp, ...values] = line.split(",");
    const v = values.map(Number);
    yield {
      ns: BigInt(stamp), topic: "/imu",
      message: {
        header: { stamp: stampOf(BigInt(stamp)), frame_id: "imu" },
        orientation: { x: 0, y: 0, z: 0, w: 0 }, orientation_covariance: [-1, 0, 0, 0, 0, 0, 0, 0, 0],
        angular_velocity: { x: v[0], y: v[1], z: v[2] }, angular_velocity_covariance: new Array(9).fill(0),
        linear_acceleration: { x: v[3], y: v[4], z: v[5] }, linear_acceleration_covariance: new Array(9).fill(0),
      },
    };
  }
}

function* cloudMessages(folder) {
  const fields = [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["intensity", 12, 7], ["t", 16, 6], ["ring", 20, 4]];
  for (const file of fs.readdirSync(folder)) {
    const stamp = BigInt(path.basename(file, ".bin"));
    const data = new Uint8Array(fs.readFileSync(path.join(folder, file)));
    yield {
      ns: stamp, topic: "/lidar",
      message: {
        header: { stamp: stampOf(stamp), frame_id: "lidar" }, height: 1, width: data.length / POINT_BYTES,
        fields: fields.map(([name, offset, datatype]) => ({ name, offset, datatype, count: 1 })),
        is_bigendian: false, point_step: POINT_BYTES, row_step: data.length, data, is_dense: true,
      },
    };
  }
}

async function main([dump, out, compression]) {
  const types = { "/imu": "sensor_msgs/Imu", "/lidar": "sensor_msgs/PointCloud2" };
  const messages = [...imuMessages(path.join(dump, "imu.csv")), ...cloudMessages(path.join(dump, "scans"))];
  messages.sort((a, b) => (a.ns < b.ns ? -1 : a.ns > b.ns ? 1 : 0));
  const file = fs.openSync(out, "w");
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (buffer) => { fs.writeSync(file, buffer); position += BigInt(buffer.byteLength); },
  };
  const compressChunk = compression === "none" ? undefined : (data) => ({
    compression,
    compressedData: new Uint8Array(childProcess.execFileSync(compression, ["-c", "-q"], { input: data, maxBuffer: 1 << 28 })),
  });
  const mcap = new McapWriter({ writable, compressChunk, chunkSize: 256 * 1024 });
  await mcap.start({ profile: "ros2", library: "test" });
  const writers = {}, channels = {};
  for (const [topic, type] of Object.entries(types)) {
    writers[topic] = writerOf(type);
    const schemaId = await mcap.registerSchema({ name: type.replace("/", "/msg/"), encoding: "ros2msg", data: new Uint8Array() });
    channels[topic] = await mcap.registerChannel({ schemaId, topic, messageEncoding: "cdr", metadata: new Map() });
  }
  for (const { ns, topic, message } of messages)
    await mcap.addMessage({ channelId: channels[topic], sequence: 0, logTime: ns, publishTime: ns, data: writers[topic].writeMessage(message) });
  await mcap.end();
  fs.closeSync(file);
}

main(process.argv.slice(2)).catch((error) => { console.error(error); process.exit(1); });
