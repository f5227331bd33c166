#!/usr/bin/env python3
"""names.py ROOT: fails if a source names something with a word of RULED_OUT (CONTRIBUTING.md, Terms).
Comments and texts are prose and may have any word, and so may the names of tests."""
import pathlib
import re
import sys

FOLDERS = ('apps', 'include', 'lab', 'packaging', 'samples', 'src', 'tests')
ENDS = {'.c', '.cpp', '.cs', '.h', '.js', '.mjs', '.ts'}
RULED_OUT = {'most': 'max', 'least': 'min'}
# As a name or at its end; a verb at its beginning, place_foot, may stay.
VAGUE = {'way': 'direction, path or variant', 'ways': 'directions, paths or variants', 'place': 'position or index',
         'places': 'positions or indices', 'how': 'method or mode', 'wide': 'width'}
PROSE = re.compile(r'''//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`'''
                   r'|(?<=[(, ])/(?![/*\s=])(?:\\.|[^/\\\n])+/(?=[\w).,;])'  # A regular expression.
                   r'|\bTEST(?:_F|_P)?\([^)]*\)', re.DOTALL)
NAME = re.compile(r'[A-Za-z_]\w*')
PART = re.compile(r'[A-Z]?[a-z]+|[A-Z]+(?![a-z])')


def names_in(text):
    """Each name with its line."""
    code = PROSE.sub(lambda prose: '\n' * prose.group().count('\n'), text)
    for number, line in enumerate(code.split('\n'), 1):
        for name in NAME.findall(line):
            yield number, name


def main(root):
    found = 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob('*')):
            if path.suffix not in ENDS or 'node_modules' in path.parts:
                continue
            for number, name in names_in(path.read_text(errors='replace')):
                parts = [part.lower() for part in PART.findall(name)]
                wanted = [RULED_OUT[part] for part in parts if part in RULED_OUT]
                if parts and parts[-2:] != ['in', 'place']:
                    wanted += [VAGUE[part] for part in parts[-1:] if part in VAGUE]
                for word in wanted:
                    found += 1
                    print(f'{path.relative_to(root)}:{number}: {name}: expected {word}')
    return 1 if found else 0


sys.exit(main(pathlib.Path(sys.argv[1])))
