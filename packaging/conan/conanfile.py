"""Conan 2: `conan create CHECKOUT/packaging/conan` makes a package of the checkout."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir


class PanacheRecipe(ConanFile):
    name = 'panache'
    description = "Changes the style of a character's motion in real time"
    license = 'Apache-2.0'
    topics = ('animation', 'motion', 'style-transfer')
    package_type = 'library'
    settings = 'os', 'compiler', 'build_type', 'arch'
    options = {'shared': [True, False]}
    default_options = {'shared': False}

    @property
    def _checkout(self):
        return os.path.join(self.recipe_folder, os.pardir, os.pardir)

    def set_version(self):
        text = load(self, os.path.join(self._checkout, 'CMakeLists.txt'))
        self.version = re.search(r'^project\(panache VERSION ([0-9.]+)', text, re.MULTILINE).group(1)

    def export_sources(self):
        for pattern in ('CMakeLists.txt', 'LICENSE', 'include/*', 'src/*',
                        'models/panache-int8.safetensors'):
            copy(self, pattern, self._checkout, self.export_sources_folder)

    def requirements(self):
        # What links the static library links Highway too; the others are headers of the sources.
        self.requires('highway/[>=1.0.3 <2]')
        self.requires('fast_float/[>=3.9 <9]', visible=False)
        self.requires('nlohmann_json/[>=3.11 <4]', visible=False)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables['PANACHE_PROGRAM'] = False
        toolchain.cache_variables['BUILD_SHARED_LIBS'] = bool(self.options.shared)
        toolchain.generate()
        dependencies = CMakeDeps(self)
        # By the names of these packages' own CMake files.
        dependencies.set_property('highway', 'cmake_file_name', 'hwy')
        dependencies.set_property('highway::hwy', 'cmake_target_name', 'hwy::hwy')
        dependencies.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        for folder in ('lib/cmake', 'lib/pkgconfig', 'share'):  # Conan writes its own.
            rmdir(self, os.path.join(self.package_folder, folder))
        copy(self, 'LICENSE', self.source_folder, os.path.join(self.package_folder, 'licenses'))
        copy(self, 'panache-int8.safetensors', os.path.join(self.source_folder, 'models'),
             os.path.join(self.package_folder, 'res'))

    def package_info(self):
        self.cpp_info.libs = ['panache']
        self.cpp_info.set_property('cmake_file_name', 'Panache')
        self.cpp_info.set_property('cmake_target_name', 'Panache::panache')
        self.cpp_info.set_property('pkg_config_name', 'panache')
        self.cpp_info.resdirs = ['res']
        if self.settings.os in ('Linux', 'FreeBSD') and not self.options.shared:
            self.cpp_info.system_libs = ['m', 'pthread']
