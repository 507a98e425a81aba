// Validates glTF files: one path a line on stdin, one JSON report a line on stdout.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { validateBytes } from "gltf-validator";

for await (const path of createInterface({ input: process.stdin })) {
  const fetched = (uri) =>
    Promise.resolve().then(() => new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))));
  let report;
  try {
    report = await validateBytes(new Uint8Array(readFileSync(path)), {
      uri: path,
      maxIssues: 1000,
      externalResourceFunction: fetched,
    });
  } catch (error) {
    report = { issues: { messages: [{ code: "UNREADABLE", severity: 0, pointer: "", message: String(error) }] } };
  }
  console.log(JSON.stringify({ path, messages: report.issues.messages }));
}
