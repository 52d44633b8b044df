# SPDX-License-Identifier: Apache-2.0
"""The files of a C++ package."""

from __future__ import annotations

from ros2pkg.create.package import PackageDescription, Writer

HEAD = """\
cmake_minimum_required(VERSION 3.10)
project({name})

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()

find_package(ament_cmake REQUIRED)
{dependencies}
"""

NODE_RULES = """\
add_executable({node} src/{node}.cpp)
target_include_directories({node} PUBLIC
  $<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>
  $<INSTALL_INTERFACE:include/${{PROJECT_NAME}}>)
target_compile_features({node} PUBLIC c_std_99 cxx_std_17)
{linked}install(TARGETS {node} DESTINATION lib/${{PROJECT_NAME}})

"""

NODE = """\
#include <cstdio>

int main(int argc, char ** argv)
{{
  (void) argc;
  (void) argv;

  printf("hello world {name} package\\n");
  return 0;
}}
"""


def write_sources(description: PackageDescription, writer: Writer) -> None:
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
        writer.file(f'src/{description.node_name}.cpp', NODE.format(name=description.name))
    writer.file('CMakeLists.txt', _cmake_lists(description))


def _cmake_lists(description: PackageDescription) -> str:
    found = ''.join(f'find_package({name} REQUIRED)\n' for name in description.dependencies)
    text = HEAD.format(name=description.name, dependencies=found)
    if description.node_name:
        text += NODE_RULES.format(node=description.node_name, linked=_linked(description))
    return text + 'ament_package()\n'


def _linked(description: PackageDescription) -> str:
    if not description.dependencies:
        return ''
    names = ''.join(f'\n  "{name}"' for name in description.dependencies)
    return f'ament_target_dependencies({description.node_name}{names})\n'
