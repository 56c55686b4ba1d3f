// Reads a log with the format's own library and holds every message against its schema, and against Foxglove's
// published ones: npm install && node check.mjs LOG.mcap
import { readFileSync } from "node:fs";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import published from "@foxglove/schemas/jsonschema.js";
import Ajv from "ajv";

const bytes = readFileSync(process.argv[2]);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
};
const reader = await McapIndexedReader.Initialize({ readable });
const ajv = new Ajv({ strict: false });
const checks = new Map();
for (const schema of reader.schemasById.values()) {
  const own = ajv.compile(JSON.parse(new TextDecoder().decode(schema.data)));
  const official = published[schema.name.replace("foxglove.", "")];
  checks.set(schema.id, official ? [own, ajv.compile(official)] : [own]);
}
const counts = new Map();
let last = 0n;
for await (const message of reader.readMessages()) {
  if (message.logTime < last) throw new Error(`time runs backwards at ${message.logTime}`);
  last = message.logTime;
  const channel = reader.channelsById.get(message.channelId);
  const value = JSON.parse(new TextDecoder().decode(message.data));
  for (const check of checks.get(channel.schemaId))
    if (!check(value)) throw new Error(`${channel.topic}: ${ajv.errorsText(check.errors)}`);
  counts.set(channel.topic, (counts.get(channel.topic) ?? 0) + 1);
}
let jump = 0;
for await (const message of reader.readMessages({ startTime: last / 2n })) {
  if (message.logTime < last / 2n) throw new Error("the index leads to the wrong time");
  ++jump;
}
const stream = new McapStreamReader();
stream.append(new Uint8Array(bytes));
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") ++streamed;
const total = [...counts.values()].reduce((a, b) => a + b, 0);
if (BigInt(total) !== reader.statistics.messageCount || streamed !== total) throw new Error("messages are missing");
for (const [topic, count] of counts) console.log(`${topic}: ${count}`);
console.log(`${total} messages, ${jump} in the second half, ${reader.chunkIndexes.length} chunks: fine`);
