"""sbom_test.py ROOT: what scripts/sbom writes is SPDX 2.3, and has every package that scripts/install
installs, every one of the lock files of npm, and every model with the checksum that it has."""
import glob
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile

root = sys.argv[1]
failures = []


def expect(good, message):
    if not good:
        failures.append(message)


with tempfile.TemporaryDirectory() as folder:
    texts = []
    for name in ('a.json', 'b.json'):
        path = os.path.join(folder, name)
        subprocess.run([os.path.join(root, 'scripts/sbom'), path], check=True)
        with open(path, encoding='utf-8') as file:
            texts.append(file.read())
expect(texts[0] == texts[1], 'two runs differ')
document = json.loads(texts[0])
packages = document['packages']

expect(document['spdxVersion'] == 'SPDX-2.3' and document['dataLicense'] == 'CC0-1.0',
       'the document is not SPDX 2.3')
for field in ('SPDXID', 'name', 'documentNamespace', 'creationInfo'):
    expect(document.get(field), f'the document has no {field}')
identifiers = [package['SPDXID'] for package in packages]
expect(len(identifiers) == len(set(identifiers)), 'identifiers are not unique')
for identifier in identifiers:
    expect(re.fullmatch(r'SPDXRef-[A-Za-z0-9.-]+', identifier), f'{identifier}: not an identifier')
related = {(r['spdxElementId'], r['relatedSpdxElement']) for r in document['relationships']}
for package in packages[1:]:
    name = package['name']
    for field in ('versionInfo', 'downloadLocation', 'licenseDeclared', 'comment'):
        expect(package.get(field), f'{name}: no {field}')
    expect(package['licenseDeclared'] != 'NOASSERTION' or package['licenseComments'],
           f'{name}: no licence')
    expect((package['SPDXID'], identifiers[0]) in related, f'{name}: no relation to panache')

named = {(package['name'], package['versionInfo']) for package in packages}
names = {package['name'] for package in packages}
with open(os.path.join(root, 'scripts/install'), encoding='utf-8') as file:
    lists = re.findall(r"^[^#\n]*?(?:wanted|build|check|lab)\+?=\(([^)]*)\)", file.read(), re.MULTILINE)
installed = {word for line in lists for word in re.findall(r'(?<![\w$"{@\[-])[a-z][a-z0-9+.-]+', line)}
expect(len(installed) > 40, f'scripts/install: only {len(installed)} packages were found')
for word in sorted(installed):
    expect(word in names, f'{word}: installed by scripts/install, but docs/dependencies.md has no '
           'line with it')
for folder in ('apps/web', 'tests/web'):
    with open(os.path.join(root, folder, 'package-lock.json'), encoding='utf-8') as file:
        for path, entry in json.load(file)['packages'].items():
            if path:
                name = path.split('node_modules/')[-1]
                expect((name, entry['version']) in named, f'{folder}: {name} is missing')
models = glob.glob(os.path.join(root, 'models/*.safetensors'))
expect(len(models) >= 4, 'the models are missing')
for path in models:
    with open(path, 'rb') as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    name = os.path.basename(path)
    listed = [p['checksums'][0]['checksumValue'] for p in packages if p['name'] == name]
    expect(listed == [digest], f'models/SHA256SUMS: {name} has {digest}, found {listed}')
print(f'{len(packages)} packages, {len(installed)} of scripts/install, {len(models)} models')
sys.exit('\n'.join(failures) or 0)
