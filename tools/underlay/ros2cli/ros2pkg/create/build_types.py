# SPDX-License-Identifier: Apache-2.0
"""The files of a new package: what all have, and the sources of its build type, C++ or Python."""

from __future__ import annotations

from ros2pkg.create.package import license_text, manifest_text, PackageDescription, Writer

CMAKE_HEAD = """\
cmake_minimum_required(VERSION 3.10)
project({name})

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()

find_package(ament_cmake REQUIRED)
{dependencies}
"""

CMAKE_NODE = """\
add_executable({node} src/{node}.cpp)
target_include_directories({node} PUBLIC
  $<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>
  $<INSTALL_INTERFACE:include/${{PROJECT_NAME}}>)
target_compile_features({node} PUBLIC c_std_99 cxx_std_17)
{linked}install(TARGETS {node} DESTINATION lib/${{PROJECT_NAME}})

"""

CPP_NODE = """\
#include <cstdio>

int main(int argc, char ** argv)
{{
  (void) argc;
  (void) argv;

  printf("hello world {name} package\\n");
  return 0;
}}
"""

SETUP_PY = """\
from setuptools import find_packages, setup

package_name = {package.name!r}

setup(
    name=package_name,
    version={package.version!r},
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={package.maintainer_name!r},
    maintainer_email={package.maintainer_email!r},
    description={package.description!r},
    license={package.license_id!r},
    extras_require={{
        'test': ['pytest'],
    }},
    entry_points={{
        'console_scripts': [{entries}
        ],
    }},
)
"""

SETUP_CFG = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""

PYTHON_NODE = """\
def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""

FLAKE8 = """\
from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    rc, errors = main_with_errors(argv=[])
    assert rc == 0, f'{len(errors)} code style errors or warnings:\\n' + '\\n'.join(errors)
"""

PEP257 = """\
from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found code style errors or warnings'
"""

COPYRIGHT = """\
from ament_copyright.main import main
import pytest


# Remove the `skip` decorator once the source files have a copyright header.
@pytest.mark.skip(reason='The generated source files have no copyright header yet.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found errors'
"""

TESTS = {
    'test_copyright.py': COPYRIGHT,
    'test_flake8.py': FLAKE8,
    'test_pep257.py': PEP257,
}


def create_package(description: PackageDescription, package_folder: str) -> None:
    """
    Create a package: manifest, sources, and the licence if its text is known.

    Parameters
    ----------
    description
        The package; its build type is `ament_cmake` or `ament_python`.
    package_folder
        The folder of the package, which is created, too.

    Raises
    ------
    OSError
        A folder or file cannot be written.

    """
    writer = Writer(package_folder)
    writer.file('package.xml', manifest_text(description))
    LAYOUTS[description.build_type](description, writer)
    text = license_text(description.license_id, description.maintainer_name)
    if text is not None:
        writer.file('LICENSE', text)


def _write_cmake_sources(description: PackageDescription, writer: Writer) -> None:
    """
    Write the files of an ament_cmake package, except for its manifest and licence.

    Parameters
    ----------
    description
        The package; a node gets a C++ source and its CMake rules.
    writer
        Writes below the package's folder.

    """
    print('creating source and include folder')
    writer.folder('src')
    writer.folder(f'include/{description.name}')
    if description.node_name:
        writer.file(f'src/{description.node_name}.cpp', CPP_NODE.format(name=description.name))
    writer.file('CMakeLists.txt', _cmake_lists(description))


def _cmake_lists(description: PackageDescription) -> str:
    found = ''.join(f'find_package({name} REQUIRED)\n' for name in description.dependencies)
    text = CMAKE_HEAD.format(name=description.name, dependencies=found)
    if description.node_name:
        text += CMAKE_NODE.format(node=description.node_name, linked=_linked(description))
    return text + 'ament_package()\n'


def _linked(description: PackageDescription) -> str:
    if not description.dependencies:
        return ''
    names = ''.join(f'\n  "{name}"' for name in description.dependencies)
    return f'ament_target_dependencies({description.node_name}{names})\n'


def _write_python_sources(description: PackageDescription, writer: Writer) -> None:
    """
    Write the files of an ament_python package, except for its manifest and licence.

    Parameters
    ----------
    description
        The package; a node gets a module and an entry point, a library a package of its own.
    writer
        Writes below the package's folder.

    """
    name = description.name
    print('creating source folder')
    writer.folder(name)
    writer.file('setup.py', _setup_py(description))
    writer.file('setup.cfg', SETUP_CFG.format(name=name))
    writer.folder('resource')
    writer.file(f'resource/{name}')
    writer.file(f'{name}/__init__.py')
    writer.folder('test')
    for test, text in TESTS.items():
        writer.file(f'test/{test}', text)
    if description.library_name:
        writer.folder(f'{name}/{description.library_name}')
        writer.file(f'{name}/{description.library_name}/__init__.py')
    if description.node_name:
        writer.file(f'{name}/{description.node_name}.py', PYTHON_NODE.format(name=name))


def _setup_py(description: PackageDescription) -> str:
    node = description.node_name
    entry = f"\n            '{node} = {description.name}.{node}:main'," if node else ''
    text = SETUP_PY.format(package=description, entries=entry)
    return '\n'.join(_excused(line) for line in text.split('\n'))


def _excused(line: str) -> str:
    """Append a `noqa` mark to a line that exceeds the line length of the linter."""
    return f'{line}  # noqa: E501' if len(line) > 99 else line


LAYOUTS = {
    'ament_cmake': _write_cmake_sources,
    'ament_python': _write_python_sources,
}
