"""Builds the Python package: the hooks called by `pip install CHECKOUT` and `python -m build` (PEP
517), and the metadata of the wheel that scripts/python packs.

    backend.py FOLDER     writes panache-VERSION.dist-info into an unpacked wheel
"""

import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The sources that a wheel is built from.
SOURCES = ('CMakeLists.txt', 'LICENSE', 'pyproject.toml', 'apps/python', 'include', 'models',
           'scripts/python', 'src')
# For each manylinux policy: the newest versions of glibc, GLIBCXX and CXXABI symbols.
POLICIES = (((2, 28), (3, 4, 24), (1, 3, 11)), ((2, 31), (3, 4, 28), (1, 3, 12)),
            ((2, 34), (3, 4, 29), (1, 3, 13)), ((2, 35), (3, 4, 30), (1, 3, 13)),
            ((2, 36), (3, 4, 30), (1, 3, 13)))
# Libraries that these policies expect on every system; X11 and others are not needed here.
OF_THE_SYSTEM = re.compile(r'(lib(c|m|dl|rt|pthread|util|gcc_s|stdc\+\+)\.so\.\d+|ld-linux.*)$')


def version() -> str:
    text = (ROOT / 'CMakeLists.txt').read_text(encoding='utf-8')
    return re.search(r'^project\(panache VERSION ([0-9.]+)', text, re.MULTILINE).group(1)


def _project() -> dict:
    import tomllib
    with open(ROOT / 'pyproject.toml', 'rb') as file:
        return tomllib.load(file)['project']


def metadata() -> str:
    project = _project()
    lines = ['Metadata-Version: 2.1', f'Name: {project["name"]}', f'Version: {version()}',
             f'Summary: {project["description"]}', f'Author: {project["authors"][0]["name"]}',
             f'License: {project["license"]["text"]}', f'Keywords: {",".join(project["keywords"])}',
             *(f'Classifier: {one}' for one in project['classifiers']),
             f'Requires-Python: {project["requires-python"]}',
             *(f'Requires-Dist: {one}' for one in project['dependencies']),
             'Description-Content-Type: text/markdown', 'License-File: LICENSE', '']
    return '\n'.join(lines) + '\n' + (ROOT / project['readme']).read_text(encoding='utf-8')


def _needs(library: pathlib.Path):
    """The libraries that a library needs, and its newest symbol version of each kind."""
    text = subprocess.run(['objdump', '-p', '-T', str(library)], check=True, capture_output=True,
                          text=True).stdout
    versions = {}
    for kind, number in re.findall(r'\b(GLIBC|GLIBCXX|CXXABI)_([0-9.]+)', text):
        versions.setdefault(kind, []).append(tuple(map(int, number.split('.'))))
    return re.findall(r'NEEDED +(\S+)', text), {kind: max(all_) for kind, all_ in versions.items()}


def tag(folder: pathlib.Path) -> str:
    """The tag of the oldest manylinux policy that all libraries in a folder meet, else linux."""
    libraries = sorted(folder.iterdir())
    carried = {library.name for library in libraries}
    newest = {}
    for library in libraries:
        needed, versions = _needs(library)
        for name in needed:
            if name not in carried and not OF_THE_SYSTEM.match(name):
                raise SystemExit(f'{library.name}: needs {name}, which is not in the wheel and not '
                                 'a part of every Linux')
        for kind, number in versions.items():
            newest[kind] = max(newest.get(kind, ()), number)
    for glibc, cxx, abi in POLICIES:
        if (newest.get('GLIBC', ()) <= glibc and newest.get('GLIBCXX', ()) <= cxx
                and newest.get('CXXABI', ()) <= abi):
            return f'manylinux_{glibc[0]}_{glibc[1]}_{platform.machine()}'
    return f'linux_{platform.machine()}'


def write_dist_info(wheel: pathlib.Path) -> None:
    info = wheel / f'panache-{version()}.dist-info'
    info.mkdir()
    shutil.copy(ROOT / 'LICENSE', info)
    (info / 'METADATA').write_text(metadata(), encoding='utf-8')
    (info / 'WHEEL').write_text(
        'Wheel-Version: 1.0\nGenerator: panache\nRoot-Is-Purelib: false\n'
        f'Tag: py3-none-{tag(wheel / "panache" / "lib")}\n', encoding='utf-8')


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    """Builds only the library and packs it into a wheel."""
    with tempfile.TemporaryDirectory() as folder:
        built, target = os.path.join(folder, 'build'), os.path.join(folder, 'wheel')
        subprocess.run(['cmake', '-S', str(ROOT), '-B', built, '-DPANACHE_PROGRAM=OFF',
                        '-DCMAKE_BUILD_TYPE=Release'], check=True)
        subprocess.run(['cmake', '--build', built, '--parallel', str(os.cpu_count() or 1)],
                       check=True)
        subprocess.run([str(ROOT / 'scripts/python'), os.path.join(built, 'src/api/libpanache.so'), target],
                       check=True, env={**os.environ, 'PYTHON': sys.executable})
        [wheel] = os.listdir(target)
        shutil.move(os.path.join(target, wheel), wheel_directory)
    return wheel


def build_sdist(sdist_directory, config_settings=None) -> str:
    """The sources that build_wheel() needs."""
    name = f'panache-{version()}'
    with tempfile.TemporaryDirectory() as folder:
        info = os.path.join(folder, 'PKG-INFO')
        with open(info, 'w', encoding='utf-8') as file:
            file.write(metadata())
        with tarfile.open(os.path.join(sdist_directory, f'{name}.tar.gz'), 'w:gz') as archive:
            for source in SOURCES:
                archive.add(ROOT / source, f'{name}/{source}',
                            filter=lambda one: None if '__pycache__' in one.name else one)
            archive.add(info, f'{name}/PKG-INFO')
    return f'{name}.tar.gz'


if __name__ == '__main__':
    write_dist_info(pathlib.Path(sys.argv[1]))
