"""conan_test.py ROOT: the Conan recipe, with stand-ins for Conan's modules: its version, the sources
that it exports, and the CMake variables that it sets."""
import fnmatch
import importlib.util
import os
import re
import sys
import tempfile
import types

root = sys.argv[1]
copied, variables = [], {}


def stand_in(name, **content):
    module = types.ModuleType(name)
    module.__dict__.update(content)
    sys.modules[name] = module


class Toolchain:
    def __init__(self, recipe):
        self.cache_variables = variables

    def generate(self):
        pass


class Deps(Toolchain):
    def set_property(self, *arguments):
        pass


def load(recipe, path):
    with open(path, encoding='utf-8') as file:
        return file.read()


stand_in('conan', ConanFile=object)
stand_in('conan.tools')
stand_in('conan.tools.cmake', CMake=object, CMakeDeps=Deps, CMakeToolchain=Toolchain,
         cmake_layout=None)
stand_in('conan.tools.files', load=load, rmdir=None,
         copy=lambda recipe, pattern, source, target: copied.append((pattern, source)))
spec = importlib.util.spec_from_file_location(
    'conanfile', os.path.join(root, 'packaging/conan/conanfile.py'))
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)

recipe = module.PanacheRecipe()
recipe.recipe_folder = os.path.join(root, 'packaging/conan')
recipe.export_sources_folder = recipe.source_folder = tempfile.gettempdir()
recipe.options = types.SimpleNamespace(shared=True)
recipe.set_version()
top = load(None, os.path.join(root, 'CMakeLists.txt'))
failures = []
if f'project(panache VERSION {recipe.version} ' not in top:
    failures.append(f'conanfile.py: finds version {recipe.version}')
recipe.export_sources()
for pattern, source in copied:
    folder = os.path.join(source, os.path.dirname(pattern))
    if not fnmatch.filter(os.listdir(folder), os.path.basename(pattern)):
        failures.append(f'conanfile.py: exports {pattern}, which is not there')
for folder in ('CMakeLists.txt', 'include/*', 'src/*'):
    if folder not in [pattern for pattern, _ in copied]:
        failures.append(f'conanfile.py: does not export {folder}')
recipe.generate()
if variables != {'PANACHE_PROGRAM': False, 'BUILD_SHARED_LIBS': True}:
    failures.append(f'conanfile.py: sets {variables}')
for name in variables:
    if name.startswith('PANACHE_') and not re.search(rf'^option\({name} ', top, re.MULTILINE):
        failures.append(f'conanfile.py: there is no option {name}')
sys.exit('\n'.join(failures) or 0)
