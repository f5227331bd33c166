"""check_wheel.py ROOT FOLDER: the newest wheel in FOLDER is what its tag and its metadata say, and PyPI
would take it."""

import base64
import email
import glob
import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

root, folder = sys.argv[1:]
wheel = max(glob.glob(os.path.join(folder, '*.whl')), key=os.path.getmtime)
failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


archive = zipfile.ZipFile(wheel)
names = archive.namelist()
info = next(name for name in names if name.endswith('.dist-info/METADATA')).rpartition('/')[0]
name, version, tag = re.fullmatch(r'(panache)-([0-9.]+)-py3-none-(\w+)\.whl',
                                  os.path.basename(wheel)).groups()

# The tag: no library needs a newer glibc, nor one that is not in the wheel or in every Linux.
expect(f'Tag: py3-none-{tag}\n' in archive.read(f'{info}/WHEEL').decode(), 'WHEEL: another tag')
promised = re.fullmatch(r'manylinux_(\d+)_(\d+)_\w+', tag)
expect(promised, f'{tag}: expected manylinux')
promised = tuple(map(int, promised.groups())) if promised else (0, 0)
if os.path.isdir(os.path.join(root, 'build/glibc-2.31')):
    expect(promised <= (2, 31), f'{tag}: expected manylinux_2_31 or older')
libraries = [one for one in names if re.search(r'\.so(\.\d+)*$', one)]
expect('panache/lib/libpanache.so' in libraries, 'there is no library')
with tempfile.TemporaryDirectory() as work:
    for library in libraries:
        path = archive.extract(library, work)
        text = subprocess.run(['readelf', '--wide', '--version-info', '--dynamic', path], check=True,
                              capture_output=True, text=True).stdout
        glibc = [tuple(map(int, found.split('.')))
                 for found in re.findall(r'Name: GLIBC_([0-9.]+)', text)]
        expect(glibc, f'{library}: no version of glibc was found')
        expect(max(glibc, default=(0,))[:2] <= promised, f'{library}: needs glibc {max(glibc)}')
        for needed in re.findall(r'NEEDED.*\[(.*)\]', text):
            expect(re.match(r'(libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+|ld-linux.*)\.so',
                            needed) or f'panache/lib/{needed}' in names,
                   f'{library}: needs {needed}')
        print(f'{os.path.basename(library)}: glibc {max(glibc)}, the tag says {promised}')

# What twine and PyPI look at.
metadata = email.message_from_bytes(archive.read(f'{info}/METADATA'))
for field in ('Metadata-Version', 'Name', 'Version', 'Summary', 'License', 'Requires-Python'):
    expect(metadata[field], f'METADATA: no {field}')
expect((metadata['Name'], metadata['Version']) == (name, version), 'METADATA: another name or version')
expect(len(metadata['Summary'] or '') <= 512 and '\n' not in (metadata['Summary'] or ''),
       'METADATA: PyPI takes a summary of one line')
expect(metadata['Description-Content-Type'] == 'text/markdown' and len(metadata.get_payload()) > 200,
       'METADATA: no description')
expect('License :: OSI Approved :: Apache Software License' in metadata.get_all('Classifier', []),
       'METADATA: no classifier of the licence')
expect(f'{info}/LICENSE' in names, 'there is no licence')
for line in archive.read(f'{info}/RECORD').decode().splitlines():
    path, digest, size = line.rsplit(',', 2)
    if digest:
        content = archive.read(path)
        wanted = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()
        expect(digest == f'sha256={wanted}' and int(size) == len(content), f'RECORD: {path}')
expect(len(archive.read(f'{info}/RECORD').decode().splitlines()) == len(names), 'RECORD: other files')
if shutil.which('twine'):
    check = subprocess.run(['twine', 'check', '--strict', wheel], capture_output=True, text=True)
    expect(check.returncode == 0, f'twine: {check.stdout}{check.stderr}')
else:
    print('there is no twine')

# The archive of the sources has what a wheel is built from.
spec = importlib.util.spec_from_file_location('backend', os.path.join(root, 'apps/python/backend.py'))
backend = importlib.util.module_from_spec(spec)
spec.loader.exec_module(backend)
with tempfile.TemporaryDirectory() as work:
    source = os.path.join(work, backend.build_sdist(work))
    top = f'panache-{version}'
    with tarfile.open(source) as tar:
        packed = tar.getnames()
        expect(all(one.split('/')[0] == top for one in packed), 'sources: outside of their folder')
        tar.extractall(work)
    for one in ('PKG-INFO', 'pyproject.toml', 'apps/python/panache/py.typed',
                'models/panache-int8.safetensors', 'include/panache/panache.hpp', 'LICENSE'):
        expect(f'{top}/{one}' in packed, f'sources: no {one}')
    configured = subprocess.run(
        ['cmake', '-G', 'Ninja', '-S', os.path.join(work, top), '-B', os.path.join(work, 'build'),
         '-DPANACHE_PROGRAM=OFF'], capture_output=True, text=True)
    expect(configured.returncode == 0, f'sources: {configured.stderr}')
sys.exit('\n'.join(failures) or 0)
