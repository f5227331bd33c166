// node validate.mjs FILE...: what the Khronos validator says of glTF files. Prints every error and
// warning, and ends with 1 where there is an error.
import { readFile } from 'node:fs/promises';
import { basename } from 'node:path';
import validator from 'gltf-validator';

const severities = ['error', 'warning'];
let errors = 0;
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: basename(file),
    maxIssues: 100,
  });
  const { issues } = report;
  for (const issue of issues.messages) {
    if (issue.severity >= severities.length) continue;
    console.log(`${file}: ${severities[issue.severity]}: ${issue.code}: ${issue.message} ` +
      `(${issue.pointer ?? `byte ${issue.offset}`})`);
  }
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
  errors += issues.numErrors;
}
process.exit(errors > 0 ? 1 : 0);
