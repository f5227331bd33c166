"""manifest_test.py ROOT ZIP: the extension beside the add-on ZIP has a manifest of schema 1.0.0, as
Blender's manual describes it, and both have all files that they need. Needs no Blender."""

import io
import os
import re
import sys
import tomllib
import zipfile

root, addon_zip = sys.argv[1:]
extension_zip = addon_zip.removesuffix('.zip') + '-extension.zip'
failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


# What the manual lists for add-ons: what a value has to be.
VERSION = r'\d+\.\d+\.\d+([-+][0-9A-Za-z.-]+)?'
TAGS = {'3D View', 'Add Curve', 'Add Mesh', 'Animation', 'Bake', 'Camera', 'Compositing',
        'Development', 'Game Engine', 'Geometry Nodes', 'Grease Pencil', 'Import-Export', 'Lighting',
        'Material', 'Mesh', 'Modeling', 'Node', 'Object', 'Paint', 'Physics', 'Pipeline', 'Render',
        'Rigging', 'Scene', 'Sculpt', 'Sequencer', 'System', 'Text Editor', 'Tracking',
        'User Interface', 'UV'}
PLATFORMS = {'windows-x64', 'windows-arm64', 'macos-x64', 'macos-arm64', 'linux-x64', 'linux-arm64'}
PERMISSIONS = {'files', 'network', 'clipboard', 'camera', 'microphone'}


def matches(pattern):
    return lambda value: isinstance(value, str) and re.fullmatch(pattern, value)


def all_of(check):
    return lambda values: isinstance(values, list) and values and all(map(check, values))


def line(value):
    """At most 64 characters in one line that ends in a letter, a digit or a bracket."""
    return isinstance(value, str) and re.fullmatch(r'[^\n]{0,63}[\w)\]}]', value)


REQUIRED = {
    'schema_version': matches(r'1\.0\.0'), 'id': matches(r'[a-z][a-z0-9_]*'),
    'version': matches(VERSION), 'name': matches(r'\S[^\n]*'), 'tagline': line,
    'maintainer': matches(r'\S[^\n]*'), 'type': matches('add-on'),
    'blender_version_min': matches(r'(4\.[2-9]|[5-9])\S*\.\d+'),
    'license': all_of(matches(r'SPDX:[A-Za-z0-9.+-]+')),
}
OPTIONAL = {
    'website': matches(r'https?://\S+'), 'copyright': all_of(matches(r'\d{4}(-\d{4})? \S[^\n]*')),
    'tags': all_of(TAGS.__contains__), 'platforms': all_of(PLATFORMS.__contains__),
    'blender_version_max': matches(VERSION), 'wheels': all_of(matches(r'\./wheels/\S+\.whl')),
    'permissions': lambda table: isinstance(table, dict) and table and set(table) <= PERMISSIONS
    and all(map(line, table.values())),
    'build': lambda table: isinstance(table, dict),
}


def check_manifest(manifest):
    for field, check in REQUIRED.items():
        expect(field in manifest, f'manifest: no {field}')
        expect(field not in manifest or check(manifest[field]),
               f'manifest: {field} is {manifest.get(field)!r}')
    for field in manifest.keys() - REQUIRED.keys():
        expect(field in OPTIONAL, f'manifest: there is no field {field}')
        expect(field not in OPTIONAL or OPTIONAL[field](manifest[field]),
               f'manifest: {field} is {manifest[field]!r}')


def check_files(archive, top):
    names = archive.namelist()
    expect(archive.testzip() is None, f'{archive.filename}: is broken')
    expect(all(name.startswith(top) for name in names), f'{archive.filename}: files outside of {top}')
    sources = os.listdir(os.path.join(root, 'apps/blender/panache'))
    needed = [name for name in sources if name.endswith('.py')] + ['LICENSE', 'README.md']
    for name in needed:
        expect(top + name in names, f'{archive.filename}: no {top}{name}')
    expect(not any(re.search(r'__pycache__|\.pyc$|/\.', name) for name in names),
           f'{archive.filename}: files of a cache or hidden ones')
    expect(b'MIT License' in archive.read(top + 'LICENSE'), f'{archive.filename}: is not under MIT')
    return {name.removeprefix(top) for name in names if not name.endswith('/')}


def check_package(archive, top):
    """The Python package, in its folder `top`."""
    for name in ('__init__.py', 'lib/libpanache.so', 'models/panache-int8.safetensors',
                 'models/neutral.safetensors', 'models/README.md'):
        expect(top + name in archive.namelist(), f'{archive.filename}: no {top}{name}')
    expect(len(archive.read(f'{top}lib/libpanache.so')) > 500_000, 'the library is too small')


with zipfile.ZipFile(addon_zip) as addon, zipfile.ZipFile(extension_zip) as extension:
    of_addon, of_extension = check_files(addon, 'panache/'), check_files(extension, '')
    manifest = tomllib.loads(extension.read('blender_manifest.toml').decode())
    wheels = {name.removeprefix('./') for name in manifest['wheels']}
    expect(of_extension - of_addon == {'blender_manifest.toml'} | wheels and len(wheels) == 1 and
           all(name.startswith('core/') for name in of_addon - of_extension),
           f'the zips differ in {of_addon ^ of_extension}')
    expect(manifest['license'] == ['SPDX:MIT'], 'manifest: not the licence of the file LICENSE')
    check_package(addon, 'panache/core/')
    for name in wheels:
        with zipfile.ZipFile(io.BytesIO(extension.read(name))) as wheel:
            check_package(wheel, 'panache/')
    check_manifest(manifest)
    # What the code does is what the permissions say.
    text = b''.join(extension.read(name) for name in of_extension if name.endswith('.py')).decode()
    text = re.sub(r'""".*?"""', '', text, flags=re.DOTALL)  # Code alone.
    uses = {'files': r'\bopen\(', 'network': r'\bimport (urllib|requests|socket|http)\b|\bfrom (urllib|http)\b',
            'clipboard': r'\.clipboard\b'}
    for permission, pattern in uses.items():
        expect((re.search(pattern, text) is not None) == (permission in manifest['permissions']),
               f'manifest: permission {permission} is not what the code does')
    # In the add-on it would find the add-on itself.
    expect(not re.search(r'^\s*(import panache|from panache)\b', text, re.MULTILINE),
           'an import by the name of the add-on')

# The checks find faults.
count = len(failures)
for field, value in (('tagline', 'It ends.'), ('license', ['Apache-2.0']), ('tags', ['Motion']),
                     ('permissions', {'files': 'Ends with a dot.'}), ('blender_version_min', '3.4.0')):
    check_manifest({**manifest, field: value})
found = len(failures) - count
del failures[count:]
expect(found >= 5, f'only {found} of 5 planted faults were found')
print(f'{len(of_extension)} files, {len(manifest)} fields')
sys.exit('\n'.join(failures) or 0)
