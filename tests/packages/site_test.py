"""site_test.py SITE ROOT: the site of the documentation has every page, also as Markdown and in its
search and llms.txt; it names the version; the reference of the C interface has a group for each section
of the header; and every link on it leads to a file and, where it names one, to an anchor."""
import html.parser
import json
import os
import re
import sys
import urllib.parse

site, root = sys.argv[1:]
failures = []
if not os.path.isdir(site):
    print('not run: there is no site')
    sys.exit(77)


def expect(holds, message):
    if not holds:
        failures.append(message)


def read(*path):
    with open(os.path.join(*path), encoding='utf-8') as file:
        return file.read()


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ('href', 'src') and value:
                self.links.append(value)
            elif name in ('id', 'name') and value:
                self.anchors.add(value)


pages = {}
for folder, _, files in os.walk(site):
    for name in files:
        path = os.path.join(folder, name)
        if name.endswith('.html'):
            pages[os.path.relpath(path, site)] = Page(read(path))
count = 0
for name, page in pages.items():
    if name == '404.html' or name.startswith('c/search/'):
        continue  # Links of a page without an address of its own; links of scripts.
    for link in page.links:
        target = urllib.parse.urlsplit(link)
        if target.scheme or target.netloc or link.startswith('javascript'):
            continue
        count += 1
        path = name
        if target.path:
            path = os.path.normpath(os.path.join(os.path.dirname(name), urllib.parse.unquote(target.path)))
        if path == '.' or path.endswith('/'):
            path = os.path.join(path, 'index.html')
        if not os.path.exists(os.path.join(site, path)):
            failures.append(f'{name}: {link} is not there')
        elif target.fragment and path in pages:
            anchor = urllib.parse.unquote(target.fragment)
            expect(anchor in pages[path].anchors, f'{name}: {link} names no anchor')

version = re.search(r'^project\(panache VERSION ([0-9.]+)', read(root, 'CMakeLists.txt'), re.MULTILINE)[1]
for name in ('index.html', 'c/index.html'):
    expect(version in read(site, name), f'{name} does not show version {version}')
found = {entry['location'].partition('#')[0] for entry in
         json.loads(read(site, 'search', 'search_index.json'))['docs']}
listed = re.findall(r'^- \[[^]]+\]\(([^)]+)\)', read(site, 'llms.txt'), re.MULTILINE)
sources = [f'docs/{name}' for name in os.listdir(os.path.join(root, 'docs')) if name.endswith('.md')]
for source in sources:
    expect(source[:-2] + 'html' in pages, f'{source} is no page')
    expect(source[:-2] + 'html' in found, f'the search does not find {source}')
    expect(source in listed, f'llms.txt does not list {source}')
for name in listed:
    expect(os.path.exists(os.path.join(site, name)), f'llms.txt: {name} is not there')
header = read(root, 'include', 'panache', 'panache.h')
groups = re.findall(r'^/\* ---- (.*?) -*(?: \*/)?$', header, re.MULTILINE)
expect(len(groups) > 8, f'only {groups} are sections of the header')
for group in groups:
    expect(f'>{group}<' in read(site, 'c', 'modules.html'), f'the C reference has no group {group}')
introduction = re.search(r'Conventions\. (.*)', header)[1]
expect(introduction[:30] in read(site, 'c', 'index.html'), 'the C reference does not begin with the introduction')

print(f'{count} links on {len(pages)} pages, {len(listed)} of them listed for language models')
expect(count > 1000, f'only {count} links were found')
sys.exit('\n'.join(failures[:40]) or 0)
