"""links_test.py ROOT: every link within the pages of the project leads to a file and, where it names
one, to a heading."""
import os
import re
import sys
import unicodedata

root = sys.argv[1]
pages = []
for folder, folders, files in os.walk(root):
    folders[:] = [name for name in folders if name not in ('build', 'node_modules') and name[0] != '.']
    pages += [os.path.relpath(os.path.join(folder, name), root) for name in files if name.endswith('.md')]
failures = []


def text_of(path):
    """The page without its code, in which brackets and hashes mean something else."""
    with open(os.path.join(root, path), encoding='utf-8') as file:
        text = re.sub(r'^```.*?^```', '', file.read(), flags=re.MULTILINE | re.DOTALL)
    return text


def anchors_of(path):
    """What GitHub makes of its headings: lower case, no punctuation, hyphens for spaces."""
    anchors = set()
    for heading in re.findall(r'^#+ +(.*)$', text_of(path), re.MULTILINE):
        heading = re.sub(r'\[([^]]*)\]\([^)]*\)|<!--.*?-->', r'\1', heading).replace('`', '')
        anchor = ''.join(c for c in heading.strip().lower()
                         if c in ' -_' or unicodedata.category(c)[0] in 'LN').replace(' ', '-')
        number = 0
        while (anchor if number == 0 else f'{anchor}-{number}') in anchors:
            number += 1
        anchors.add(anchor if number == 0 else f'{anchor}-{number}')
    return anchors


count = 0
for page in pages:
    text = re.sub(r'`[^`\n]*`', '', text_of(page))
    for target in re.findall(r'\]\(([^)\s]+)\)', text):
        # The host of the repository has releases beside the files.
        if re.match(r'[a-z]+:', target) or target == '../../releases/latest':
            continue
        count += 1
        name, _, anchor = target.partition('#')
        path = os.path.normpath(os.path.join(os.path.dirname(page), name)) if name else page
        if path.startswith('..') or not os.path.exists(os.path.join(root, path)):
            failures.append(f'{page}: {target} is not there')
        elif anchor and anchor not in anchors_of(path):
            failures.append(f'{page}: {target} names no heading of {path}')

print(f'{count} links in {len(pages)} pages')
if count < 100:
    failures.append(f'only {count} links were found')
sys.exit('\n'.join(failures) or 0)
