# SPDX-License-Identifier: Apache-2.0
"""Mends what the wheels of PyPI leave open, in the environment's own copies.

- Their CMake files name the Python of the machine that built them.
- rosidl_adapter reads the names of its own output as ASCII: a path with other letters fails.
- The libraries that they bring along lie in a dozen folders: links in lib/ make one of them do.
- Their start-up hook loads half of pathlib into every Python, and starts the small Python that
  reads colcon's set-up files a second time in an environment that the shell does not have.
- Every program that imports a message loads the generator of messages, with a parser of IDL.
- The program xacro says of an error neither the line nor, in some cases, anything but a traceback:
  that of the underlay takes its place, and uses the module of the wheel.
- The page's server, viser, sets an event of its event loop from other threads. Set in the moment
  before somebody waits for it, it wakes nobody, then or later: the page stands still for good.
- bin/activate, which Python users source, knows nothing of the variables of ROS.
"""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import re

BUILD_PYTHON = re.compile(r'/opt/python/cp\d+-cp\d+/include/python3\.\d+')
BUILD_NUMPY = re.compile(r'/opt/python/[^;"]*/numpy/_core/include')
ASCII_READ = 'file(STRINGS "${idl_output}" idl_tuples)'
UTF8_READ = 'file(STRINGS "${idl_output}" idl_tuples ENCODING UTF-8)'
START_UP_HOOK = (
    "import os, sys; os.environ.get('_ROS_WHEELS_BOOTSTRAP_COMPLETE') or "
    "sys.orig_argv[1:2] and sys.orig_argv[1].endswith('/_local_setup_util_sh.py') or "
    "__import__('ros_wheels_bootstrapper')\n"
)
ACTIVATION = """
# What ROS needs besides PATH.
if [ -n "${BASH_VERSION:-}" ] && [ -f "$VIRTUAL_ENV/setup.bash" ]; then
    . "$VIRTUAL_ENV/setup.bash"
elif [ -n "${ZSH_VERSION:-}" ] && [ -f "$VIRTUAL_ENV/setup.zsh" ]; then
    . "$VIRTUAL_ENV/setup.zsh"
fi
"""
SET_FROM_OTHER_THREAD = """\
            self.message_event.set()
            if self.atomic_counter == 0:"""
SET_IN_EVENT_LOOP = """\
            if self.atomic_counter == 0:"""
GENERATOR_IMPORT = re.compile(r'try:\n    from \.generate_py_impl import .*', re.DOTALL)
GENERATOR_WHEN_NEEDED = """\
def __getattr__(name):
    if name != 'generate_py':
        raise AttributeError(name)
    from .generate_py_impl import generate_py

    return generate_py
"""


def mend_wheels(environment: Path, include: str, site_packages: Path) -> None:
    """Mend all; harmless where it is mended already.

    environment: the prefix of the wheels; include: the folder with Python.h; site_packages: the
    environment's own.
    """
    numpy_include = str(site_packages / 'numpy' / '_core' / 'include')
    for path in sorted(environment.glob('share/*/cmake/*.cmake')):
        _rewrite(path, lambda text: _name_python(text, include, numpy_include))
    adapter = environment / 'share/rosidl_adapter/cmake/rosidl_adapt_interfaces.cmake'
    _rewrite(adapter, lambda text: text.replace(ASCII_READ, UTF8_READ))
    hook = site_packages / 'ros_wheels_bootstrapper.pth'
    _rewrite(hook, lambda text: START_UP_HOOK)
    generator = site_packages / 'rosidl_generator_py' / '__init__.py'
    _rewrite(generator, lambda text: GENERATOR_IMPORT.sub(GENERATOR_WHEN_NEEDED, text))
    buffer = site_packages / 'viser' / 'infra' / '_async_message_buffer.py'
    _rewrite(buffer, lambda text: text.replace(SET_FROM_OTHER_THREAD, SET_IN_EVENT_LOOP))
    xacro = environment / 'bin' / 'xacro'
    _rewrite(xacro, lambda text: text.replace('from xacro import', 'from xacro_program import'))
    activate = environment / 'bin' / 'activate'
    _rewrite(activate, lambda text: text if ACTIVATION in text else text + ACTIVATION)
    link_libraries(environment / 'lib', site_packages)


def _name_python(text: str, include: str, numpy_include: str) -> str:
    if '/opt/python/' not in text:
        return text
    text = BUILD_NUMPY.sub(lambda _: numpy_include, text)
    return BUILD_PYTHON.sub(lambda _: include, text)


def _rewrite(path: Path, change: Callable[[str], str]) -> None:
    """Replace a file by its changed text in one step, so that no half file is ever seen."""
    text = path.read_text(encoding='utf-8')
    changed = change(text)
    if changed == text:
        return
    new = path.with_name(path.name + '.new')
    new.write_text(changed, encoding='utf-8')
    new.chmod(path.stat().st_mode)
    new.replace(path)


def link_libraries(library_folder: Path, site_packages: Path) -> None:
    """Link the libraries that wheels bring along into the folder of all libraries."""
    for source in sorted(site_packages.glob('ros_*.libs/*.so*')):
        link = library_folder / source.name
        if not link.exists():
            link.unlink(missing_ok=True)
            link.symlink_to(os.path.relpath(source, library_folder))
