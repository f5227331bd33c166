"""files_test.py PACKAGE: the files of the Unity package as Unity wants them: a package.json, beside
each file and folder a .meta with a GUID of its own, and libraries that need nothing unusual."""
import json
import os
import re
import subprocess
import sys

package = sys.argv[1]
failures = []
guids = {}
for folder, folders, files in os.walk(package):
    for name in folders + files:
        path = os.path.join(folder, name)
        short = os.path.relpath(path, package)
        if name.endswith('.meta'):
            if not os.path.exists(path[:-5]):
                failures.append(f'{short}: there is no {short[:-5]}')
            continue
        if not os.path.exists(path + '.meta'):
            failures.append(f'{short}: has no .meta, so Unity leaves it out')
            continue
        with open(path + '.meta', encoding='utf-8') as file:
            text = file.read()
        guid = re.search(r'^guid: ([0-9a-f]{32})$', text, re.MULTILINE)
        if guid is None:
            failures.append(f'{short}.meta: has no guid')
        elif guid.group(1) in guids:
            failures.append(f'{short}.meta: has the guid of {guids[guid.group(1)]}')
        else:
            guids[guid.group(1)] = short
        if ('folderAsset: yes' in text) != os.path.isdir(path):
            failures.append(f'{short}.meta: expected folderAsset for folders alone')

with open(os.path.join(package, 'package.json'), encoding='utf-8') as file:
    about = json.load(file)
if not re.fullmatch(r'[a-z0-9-]+(\.[a-z0-9-]+)+', about['name']):
    failures.append(f"package.json: '{about['name']}' is no package name")
with open(os.path.join(package, 'Runtime', 'Panache.asmdef'), encoding='utf-8') as file:
    json.load(file)

plugins = os.path.join(package, 'Runtime', 'Plugins', 'x86_64')
usual = re.compile(r'(libc|libm|libpthread|libstdc\+\+|libgcc_s|ld-linux-x86-64|libpanache_hwy)\.so(\.\d+)?')
for name in os.listdir(plugins):
    if not name.endswith('.so'):
        continue
    needed = subprocess.run(['patchelf', '--print-needed', os.path.join(plugins, name)],
                            capture_output=True, text=True, check=True).stdout.split()
    failures += [f'{name}: needs {library}' for library in needed if not usual.fullmatch(library)]
sys.exit('\n'.join(failures) or 0)
