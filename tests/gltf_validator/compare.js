// Prints the errors and warnings that an output has more often than its input.
//
//   node compare.js INPUT OUTPUT [INPUT OUTPUT ...]
//
// Two folders in the place of two files compare all .glb and .gltf files of the same stem.
// Exits with 1 where an output has new errors, with 2 where it only has new warnings.

import fs from "node:fs";
import path from "node:path";
import validator from "gltf-validator";

const SEVERITIES = ["error", "warning"];

const isModel = (name) => /\.(glb|gltf)$/i.test(name);

function pairsOfFolders(input, output) {
  const stem = (name) => name.replace(/\.[^.]*$/, "");
  const inputs = new Map(fs.readdirSync(input).filter(isModel).map((name) => [stem(name), name]));
  return fs
    .readdirSync(output)
    .filter((name) => isModel(name) && inputs.has(stem(name)))
    .sort()
    .map((name) => [path.join(input, inputs.get(stem(name))), path.join(output, name)]);
}

function pairs(args) {
  const result = [];
  for (let place = 0; place + 1 < args.length; place += 2) {
    const [input, output] = args.slice(place, place + 2);
    if (fs.statSync(input).isDirectory()) result.push(...pairsOfFolders(input, output));
    else result.push([input, output]);
  }
  return result;
}

async function messages(file) {
  const readBeside = async (uri) =>
    new Uint8Array(fs.readFileSync(path.resolve(path.dirname(file), decodeURIComponent(uri))));
  const options = { uri: path.basename(file), maxIssues: 0, externalResourceFunction: readBeside };
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), options);
  return report.issues.messages;
}

function countByCode(issues, severity) {
  const counts = new Map();
  for (const { code } of issues.filter((issue) => issue.severity === severity)) {
    counts.set(code, (counts.get(code) ?? 0) + 1);
  }
  return counts;
}

function printNew(output, before, after, severity) {
  const known = countByCode(before, severity);
  let found = false;
  for (const [code, count] of countByCode(after, severity)) {
    const more = count - (known.get(code) ?? 0);
    if (more <= 0) continue;
    const example = after.find((issue) => issue.code === code);
    const place = `${example.pointer ?? ""} ${example.message}`;
    console.log(`${output}: ${more} new ${SEVERITIES[severity]}s ${code}, such as ${place}`);
    found = true;
  }
  return found;
}

const compared = pairs(process.argv.slice(2));
let withErrors = 0;
let withWarnings = 0;
for (const [input, output] of compared) {
  const [before, after] = [await messages(input), await messages(output)];
  if (printNew(output, before, after, 0)) withErrors += 1;
  if (printNew(output, before, after, 1)) withWarnings += 1;
}
console.log(
  `${compared.length} files compared: ${withErrors} with new errors, ${withWarnings} with new warnings`,
);
if (compared.length === 0) throw new Error("no pair of files to compare");
process.exitCode = withErrors > 0 ? 1 : withWarnings > 0 ? 2 : 0;
