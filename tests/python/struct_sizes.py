"""struct_sizes.py HEADER PROGRAM: writes a C++ program that prints name, size, and names and places of
the fields of the structs of panache.h, as the compiler sees them."""

import pathlib
import re
import sys

header = re.sub(r'/\*.*?\*/', '', pathlib.Path(sys.argv[1]).read_text(encoding='utf-8'), flags=re.DOTALL)
lines = ['#include <panache/panache.h>', '#include <cstddef>', '#include <cstdio>', 'int main() {']
for body, name in re.findall(r'typedef struct \w+ \{(.*?)\} panache_(\w+);', header, re.DOTALL):
    lines.append(f'  std::printf("\\n{name} %zu", sizeof(panache_{name}));')
    for field in re.findall(r'(\w+)(?:\[\d+\])?[,;]', body):
        lines.append(f'  std::printf(" {field} %zu", offsetof(panache_{name}, {field}));')
pathlib.Path(sys.argv[2]).write_text('\n'.join([*lines, '  std::printf("\\n");', '}', '']))
