"""versions_test.py ROOT PROGRAM MANUAL WHEEL_FOLDER ADDON: all that names a version names that of
CMakeLists.txt."""
import glob
import json
import os
import re
import subprocess
import sys
import zipfile

root, program, manual, wheels, addon = sys.argv[1:]
failures = []


def read(path):
    with open(os.path.join(root, path), encoding='utf-8') as file:
        return file.read()


def found(pattern, text):
    match = re.search(pattern, text, re.MULTILINE)
    return '.'.join(match.groups()) if match else None


version = found(r'^project\(panache VERSION ([0-9.]+)', read('CMakeLists.txt'))
changelog = read('CHANGELOG.md')
citation = read('CITATION.cff')
wheel = max(glob.glob(os.path.join(wheels, '*.whl')), key=os.path.getmtime)
with zipfile.ZipFile(wheel) as archive:
    name = next(name for name in archive.namelist() if name.endswith('.dist-info/METADATA'))
    metadata = archive.read(name).decode()
tuple_of_three = r"'version': \((\d+), (\d+), (\d+)\)"
named = {
    'include/panache/panache.h': '.'.join(
        found(rf'^#define PANACHE_VERSION_{part} (\d+)', read('include/panache/panache.h')) or '?'
        for part in ('MAJOR', 'MINOR', 'PATCH')),
    'panache --version': found(r'^panache (.*)$', subprocess.run(
        [program, '--version'], capture_output=True, text=True, check=True).stdout),
    'the manual page': found(r'^\.TH .*"panache ([0-9.]+)"', read(manual)),
    'apps/web/package/package.json': json.loads(read('apps/web/package/package.json'))['version'],
    'packaging/vcpkg/panache/vcpkg.json': json.loads(
        read('packaging/vcpkg/panache/vcpkg.json'))['version'],
    'apps/unity/package.json': json.loads(read('apps/unity/package.json'))['version'],
    'the name of the wheel': found(r'panache-([0-9.]+)-', os.path.basename(wheel)),
    'the metadata of the wheel': found(r'^Version: (.*)$', metadata),
    'the add-on': found(tuple_of_three, zipfile.ZipFile(addon).read('panache/__init__.py').decode()),
    'apps/blender/blender_manifest.toml': found(
        r'^version = "([0-9.]+)"$', read('apps/blender/blender_manifest.toml')),
    'CITATION.cff': found(r'^version: (.*)$', citation),
    'CHANGELOG.md': found(r'^## \[([0-9.]+)\]', changelog),
}
for where, value in named.items():
    if value != version:
        failures.append(f'{where}: expected version {version}, found {value}')

date = found(r'^## \[[0-9.]+\] - (\d{4}-\d{2}-\d{2})$', changelog)
cited = found(r'^date-released: (.*)$', citation)
if date is None or date != cited:
    failures.append(f'CITATION.cff: expected the date of CHANGELOG.md, {date}, found {cited}')
print(f'{len(named)} places were compared with version {version}')
sys.exit('\n'.join(failures) or 0)
