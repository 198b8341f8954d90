// mrpt_fastlio: reads MCAP with npm's @mcap/core by its index, and its messages by its own definitions.
// SPDX-License-Identifier: BSD-3-Clause
//
// Usage: node read_mcap.cjs FILE
// Prints a line per topic: name, type, number of messages, sum of the content.
// FASTLIO_NODE_MODULES names the folder with @mcap/core, @foxglove/rosmsg and @foxglove/rosmsg2-serialization.
const childProcess = require("child_process");
const fs = require("fs");
const load = require("module").createRequire(process.env.FASTLIO_NODE_MODULES + "/");
const { McapIndexedReader } = load("@mcap/core");
const { parse } = load("@foxglove/rosmsg");
const { MessageReader } = load("@foxglove/rosmsg2-serialization");

const content = {
  "sensor_msgs/msg/Imu": (m) => m.linear_acceleration.z,
  "sensor_msgs/msg/PointCloud2": (m) => m.width,
  "velodyne_msgs/msg/VelodyneScan": (m) => m.packets.length,
  "nav_msgs/msg/Odometry": (m) => (m.pose.covariance[0] > 0 ? 1 : 0),
  "diagnostic_msgs/msg/DiagnosticArray": (m) => m.status[0].values.length,
  "tf2_msgs/msg/TFMessage": (m) => m.transforms.length,
};

async function main(file) {
  const bytes = fs.readFileSync(file);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(size)),
  };
  const zstd = (data) => new Uint8Array(childProcess.execFileSync("zstd", ["-d", "-c", "-q"], { input: data, maxBuffer: 1 << 28 }));
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: { zstd } });
  const readers = new Map(), topics = new Map();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!readers.has(schema.id))
      readers.set(schema.id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    const topic = topics.get(channel.topic) ?? { type: schema.name, count: 0, sum: 0 };
    topic.count += 1;
    topic.sum += content[schema.name](readers.get(schema.id).readMessage(message.data));
    topics.set(channel.topic, topic);
  }
  for (const [name, topic] of [...topics].sort()) console.log(name, topic.type, topic.count, topic.sum.toFixed(3));
}

main(process.argv[2]).catch((error) => { console.error(error); process.exit(1); });
