# SPDX-License-Identifier: Apache-2.0
"""Mends what the wheels of PyPI leave open, in the environment's own copies.

- Their CMake files name the Python of the machine that built them.
- rosidl_adapter reads the names of its own output as ASCII: a path with other letters fails.
- The libraries that they bring along lie in a dozen folders: links in lib/ make one of them do.
- Their start-up hook loads half of pathlib into every Python, and starts the small Python that
  reads colcon's set-up files a second time in an environment that the shell does not have.
- cmeel, which comes with the libraries of the tests, adds its folder of packages by a program that
  costs every Python more than its own start: a line with the name of the folder does the same.
- Every program that imports a message loads the generator of messages, with a parser of IDL and
  the standard library's logging.
- Every program that looks for a package, or imports rclpy, loads pathlib, and with it a parser of
  URLs; every node PyYAML, for files that it does not read, and a pool of threads for an executor
  that it may not have.
- The program xacro says of an error neither the line nor, in some cases, anything but a traceback:
  that of the underlay takes its place, and uses the module of the wheel.
- A signal shuts the context of a node down. The rclpy.shutdown() at the end of its main() then
  fails, so that each Ctrl-C on a node written as tutorials have it ends in a traceback.
- A signal wakes the executor of a node, and then shuts its context down, which wakes nobody. An
  executor that looks at the context in between waits for good, or fails, and SIGTERM does not end
  the node.
- An action client loses an answer that comes before its request is noted down, as it can when one
  thread sends and another spins: the goal, its result or its cancellation is waited for in vain.
- The page's server, viser, sets an event of its event loop from other threads. Set in the moment
  before somebody waits for it, it wakes nobody, then or later: the page stands still for good.
- flake8 forks helpers. In a test run that has had nodes, or simulators, a helper can wait for ever
  for a lock that one of their threads held: it gets no helpers.
- For each interface, C++ headers and two type supports of C++ are made and compiled, as long again
  as all that Python needs: here only where ROSIDL_GENERATE_CPP asks for them. And each source of
  an interface is compiled alone, though the headers that it includes take most of the time.
- A package that loses an interface keeps Python's old list of them, and then cannot be imported:
  that list depends on what CMake is told now.
- For each package three Python modules are compiled that differ in one name; rclpy loads one.
- Each of the six generators of a package parses the same interfaces anew, and for each interface
  the templates: now each is read once. What the parser of interfaces makes is kept beside them.
- That parser takes a constant of an action's feedback for one of its result, if it has the same
  name, type and value there.
- bin/activate, which Python users source, knows nothing of the variables of ROS.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import errno
from fnmatch import fnmatchcase
import os
from pathlib import Path
import re

from console import SetupError

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
GENERATOR_IMPORT = re.compile(r'try:\n    from \.generate_py_impl import .*', re.DOTALL)
UNNEEDED_IMPORTS = re.compile(r'^(?:import pathlib|from typing import .*)\n', re.MULTILINE)
FIRST_IMPORT = re.compile(r'^(?=import |from )', re.MULTILINE)
GENERATOR_WHEN_NEEDED = """\
def __getattr__(name):
    if name != 'generate_py':
        raise AttributeError(name)
    from .generate_py_impl import generate_py

    return generate_py
"""
PATH_IMPORT, PATH_USE = 'from pathlib import Path', '    return Path('
YAML_IMPORT = 'import yaml'
YAML_USES = ('        yaml_value = yaml.safe_load(', '        param_file = yaml.safe_load(')
POOL_IMPORT = 'from concurrent.futures import ThreadPoolExecutor'
POOL_USE = '        self._executor = ThreadPoolExecutor('
GENERATORS_RUN = '  ament_execute_extensions("rosidl_generate_idl_interfaces")\n'
WITHOUT_CPP = """\
  # Added where these wheels were installed: nothing in Python needs C++.
  if(NOT ROSIDL_GENERATE_CPP)
    message(STATUS "${PROJECT_NAME}: without C++, which -DROSIDL_GENERATE_CPP=ON adds")
    list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "_cpp:")
  endif()
"""
COMPILE_TOGETHER = """\
  # Added where these wheels were installed: several interfaces make one run of the compiler, which
  # spends most of its time on headers. CMAKE_UNITY_BUILD decides, where somebody sets it.
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    foreach(_suffix rosidl_generator_c rosidl_generator_py rosidl_typesupport_c
        rosidl_typesupport_fastrtps_c rosidl_typesupport_introspection_c)
      if(TARGET ${target}__${_suffix})
        set_target_properties(${target}__${_suffix} PROPERTIES
          UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
        get_target_property(_sources ${target}__${_suffix} SOURCES)
        list(FILTER _sources INCLUDE REGEX "__description[.]c$")  # each names what it refers to
        set_source_files_properties(${_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endif()
"""
KEEP_PARSED = """

# Added where these wheels were installed: several programs parse the same interface one after the
# other, and parsing takes most of their time.
_parse_idl_file = parse_idl_file


def parse_idl_file(locator, png_file=None):
    import hashlib
    import pickle
    import tempfile

    path = locator.get_absolute_path()
    kept = path.with_name(path.name + '.parsed')
    with open(__file__, 'rb') as parser:
        parts = os.fsencode(path), parser.read(), path.read_bytes()
    source = hashlib.sha256(b'\\0'.join(parts)).digest()
    try:
        content = kept.read_bytes()
        if content[: len(source)] == source and png_file is None:
            return pickle.loads(content[len(source) :])
    except OSError:
        pass
    parsed = _parse_idl_file(locator, png_file)
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as new:
            new.write(source + pickle.dumps(parsed))
        os.replace(new.name, kept)
    except OSError:  # nothing may be written there
        pass
    return parsed


parse_idl_file.__doc__ = _parse_idl_file.__doc__
"""
READ_TEMPLATES_ONCE = """

# Added where these wheels were installed: a template is read, and its expressions are compiled,
# once for all interfaces of a package, not anew for each of them.
_templates, _code = {}, {}


def _compiled(source, mode):
    if (source, mode) not in _code:
        _code[source, mode] = compile(source, '<template>', mode)
    return _code[source, mode]


def _tokens(prefix, text):
    if (prefix, text) not in _templates:
        whole = text if text.endswith('\\n') else text + prefix + '\\n'
        _templates[prefix, text] = list(iter(em.Scanner(prefix, whole).one, None))
    return _templates[prefix, text]


def _string(self, data, name='<string>', locals=None):
    self.contexts.push(em.Context(name))
    self.context().bump()
    for token in _tokens(self.prefix, data):
        token.run(self, locals)
    self.contexts.pop()


def _evaluate(self, expression, locals=None):
    self.push()
    try:
        return eval(_compiled(expression.strip(), 'eval'), self.globals, locals)
    finally:
        self.pop()


def _execute(self, statements, locals=None):
    if '\\n' not in statements:
        statements = statements.strip()
    self.push()
    try:
        exec(_compiled(statements, 'exec'), self.globals, locals)
    finally:
        self.pop()


if not em_has_configuration:
    em.Interpreter.string = _string
    em.Interpreter.evaluate, em.Interpreter.execute = _evaluate, _execute
"""
SHUTDOWN_AFTER_SIGNAL = """

# Added where these wheels were installed: a signal that ends a node shuts its context down, and
# the shutdown() that follows in its main() is no error. That a call follows a call still is one.
_shutdown, _try_shutdown = Context.shutdown, Context.try_shutdown
Context._shut_down_by_call = False


def _shutdown_after_signal(self) -> None:
    from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy

    try:
        _shutdown(self)
    except _rclpy.RCLError:
        if self._shut_down_by_call or self.ok():
            raise
        with self._lock:
            self._logging_fini()
    self._shut_down_by_call = True


def _try_shutdown_by_call(self) -> None:
    was_ok = self.ok()
    _try_shutdown(self)
    self._shut_down_by_call = self._shut_down_by_call or was_ok


_shutdown_after_signal.__doc__ = _shutdown.__doc__
_try_shutdown_by_call.__doc__ = _try_shutdown.__doc__
Context.shutdown, Context.try_shutdown = _shutdown_after_signal, _try_shutdown_by_call
"""

GUARDS_READY = """\
                guards_ready = wait_set.get_ready_entities('guard_condition')
"""
WAIT_FOR_SHUTDOWN = f"""\
{GUARDS_READY}
                # Added where these wheels were installed: a signal wakes this, and then shuts the
                # context down, which wakes nobody.
                if self._sigint_gc.handle.pointer in guards_ready:
                    for _ in range(10000):
                        if not self._context.ok():
                            raise ExternalShutdownException()
                        time.sleep(0.001)
"""
SHUT_DOWN_WHILE_WAITING = """

# Added where these wheels were installed: a signal may shut the context down after this has looked
# at it, and nothing can wait in a context that is shut down.
_wait = Executor.wait_for_ready_callbacks


def _wait_or_end(self, *args, **kwargs):
    try:
        return _wait(self, *args, **kwargs)
    except _rclpy.RCLError:
        if self._context.ok():
            raise
        raise ExternalShutdownException() from None


_wait_or_end.__doc__ = _wait.__doc__
Executor.wait_for_ready_callbacks = _wait_or_end
"""
ANSWERS_AFTER_REQUESTS = """

# Added where these wheels were installed: no thread takes an answer while another one sends a
# request that it has not noted down yet, for then nobody would be waiting for the answer.
def _in_turn(method):
    @functools.wraps(method)
    def call(self, *args, **kwargs):
        with self._requests_lock:
            return method(self, *args, **kwargs)

    return call


def _with_lock(method):
    @functools.wraps(method)
    def initialize(self, *args, **kwargs):
        self._requests_lock = threading.RLock()
        method(self, *args, **kwargs)

    return initialize


ActionClient.__init__ = _with_lock(ActionClient.__init__)
for _name in ('send_goal_async', '_cancel_goal_async', '_get_result_async', 'take_data'):
    setattr(ActionClient, _name, _in_turn(getattr(ActionClient, _name)))
"""

SET_FROM_OTHER_THREAD = """\
            self.message_event.set()
            if self.atomic_counter == 0:"""
SET_IN_EVENT_LOOP = """\
            if self.atomic_counter == 0:"""
EVERY_MODULE = 'rosidl_generator_py_get_typesupports(_typesupport_impls)\n'
ONE_MODULE = f"""\
{EVERY_MODULE}
# Added where these wheels were installed: the one that rclpy loads.
set(_typesupport_impls rosidl_typesupport_c)
"""
SOURCES_ALONE = 'DEPENDS ${target_dependencies} '
SOURCES_AND_LIST = 'DEPENDS ${target_dependencies} "${generator_arguments_file}" '
WITHOUT_HELPERS = '[flake8]\njobs = 1\n'


@dataclass(frozen=True)
class Interpreter:
    """What is mended differs with: folders of headers for C extensions, and the version's name."""

    headers: str
    numpy_headers: str
    name: str


Mend = Callable[[str, Interpreter], str]


class UnexpectedTextError(Exception):
    """A file of a wheel is not the one that was to be mended; the text that it lacks."""


def _replace(text: str, old: str, new: str) -> str:
    """Return a text with a part of it replaced, which may have been done before."""
    if new in text and (old in new or old not in text):
        return text
    if old not in text:
        raise UnexpectedTextError(old)
    return text.replace(old, new)


def _append(text: str, addition: str) -> str:
    """Return a text with an addition at its end, which may be there."""
    return text if text.endswith(addition) else text + addition


def _name_python(text: str, interpreter: Interpreter) -> str:
    if '/opt/python/' not in text:
        return text
    text = BUILD_NUMPY.sub(lambda _: interpreter.numpy_headers, text)
    return BUILD_PYTHON.sub(lambda _: interpreter.headers, text)


def _read_utf8(text: str, _: Interpreter) -> str:
    return _replace(text, ASCII_READ, UTF8_READ)


def _start_quickly(_: str, __: Interpreter) -> str:
    return START_UP_HOOK


def _name_folder(_: str, interpreter: Interpreter) -> str:
    return f'cmeel.prefix/lib/{interpreter.name}/site-packages\n'


def _import_pathlib_when_needed(text: str, _: Interpreter) -> str:
    """Import nothing for annotations, and pathlib in the function that returns a path."""
    if 'from __future__ import annotations' in text:
        return text
    text = UNNEEDED_IMPORTS.sub('', text)
    text, found = FIRST_IMPORT.subn('from __future__ import annotations\n\n', text, count=1)
    if not found:
        raise UnexpectedTextError('import')
    if 'pathlib.Path(' not in text:
        return text
    use = '    path = pathlib.Path('
    return _replace(text, use, f'    import pathlib\n\n{use}')


def _import_pathlib_for_errors(text: str, _: Interpreter) -> str:
    text = text.replace('\nfrom pathlib import Path\n', '\n')
    handler = '    except ImportError as e:\n'
    return _replace(text, handler, f'{handler}        from pathlib import Path\n\n')


def _import_in_functions(line: str, *uses: str) -> Mend:
    """Return a mend that moves an import of a module to the lines that use it, as they begin."""

    def mend(text: str, _: Interpreter) -> str:
        text = text.replace(f'\n{line}\n', '\n').replace('-> Path:', "-> 'Path':")
        for use in uses:
            indent = use[: len(use) - len(use.lstrip())]
            text = _replace(text, f'\n{use}', f'\n{indent}{line}\n\n{use}')
        return text

    return mend


def _import_when_needed(text: str, _: Interpreter) -> str:
    text = text.replace('\nimport logging\nimport traceback\n', '\n')  # for the import below
    text = GENERATOR_IMPORT.sub(GENERATOR_WHEN_NEEDED, text)
    if GENERATOR_WHEN_NEEDED not in text:
        raise UnexpectedTextError('from .generate_py_impl import')
    return text


def _say_where(text: str, _: Interpreter) -> str:
    return _replace(text, 'from xacro import', 'from xacro_program import')


def _shut_down_after_signal(text: str, _: Interpreter) -> str:
    return _append(text, SHUTDOWN_AFTER_SIGNAL)


def _end_with_context(text: str, interpreter: Interpreter) -> str:
    text = _import_in_functions(POOL_IMPORT, POOL_USE)(text, interpreter)
    return _append(_replace(text, GUARDS_READY, WAIT_FOR_SHUTDOWN), SHUT_DOWN_WHILE_WAITING)


def _note_requests_first(text: str, _: Interpreter) -> str:
    text = _replace(text, 'import threading\n', 'import functools\nimport threading\n')
    return _append(text, ANSWERS_AFTER_REQUESTS)


def _wake_event_loop(text: str, _: Interpreter) -> str:
    return _replace(text, SET_FROM_OTHER_THREAD, SET_IN_EVENT_LOOP)


def _fork_no_helpers(text: str, _: Interpreter) -> str:
    return _replace(text, '[flake8]\n', WITHOUT_HELPERS)


def _build_quickly(text: str, _: Interpreter) -> str:
    return _replace(text, GENERATORS_RUN, WITHOUT_CPP + GENERATORS_RUN + COMPILE_TOGETHER)


def _compile_one_module(text: str, _: Interpreter) -> str:
    return _replace(text, EVERY_MODULE, ONE_MODULE)


def _depend_on_list(text: str, _: Interpreter) -> str:
    return _replace(text, SOURCES_ALONE, SOURCES_AND_LIST)


def _keep_parsed(text: str, _: Interpreter) -> str:
    text = _replace(text, '    if node == target:\n', '    if node is target:\n')
    text = text.partition(KEEP_PARSED[:80])[0]  # one of before
    return text + KEEP_PARSED


def _read_templates_once(text: str, _: Interpreter) -> str:
    return _append(text, READ_TEMPLATES_ONCE)


def _activate_ros(text: str, _: Interpreter) -> str:
    return text if ACTIVATION in text else text + ACTIVATION


# Which files of the environment are mended, and how. They are not as their wheels brought them.
PACKAGES = 'lib/python3.*/site-packages'
MENDED: tuple[tuple[str, Mend], ...] = (
    ('share/*/cmake/*.cmake', _name_python),
    ('share/rosidl_adapter/cmake/rosidl_adapt_interfaces.cmake', _read_utf8),
    ('share/rosidl_cmake/cmake/rosidl_generate_interfaces.cmake', _build_quickly),
    ('share/rosidl_generator_py/cmake/custom_command.cmake', _depend_on_list),
    (
        'share/rosidl_generator_py/cmake/rosidl_generator_py_generate_interfaces.cmake',
        _compile_one_module,
    ),
    (f'{PACKAGES}/ros_wheels_bootstrapper.pth', _start_quickly),
    (f'{PACKAGES}/cmeel.pth', _name_folder),
    (f'{PACKAGES}/ament_flake8/configuration/ament_flake8.ini', _fork_no_helpers),
    (f'{PACKAGES}/ament_index_python/packages.py', _import_pathlib_when_needed),
    (f'{PACKAGES}/ament_index_python/resources.py', _import_pathlib_when_needed),
    (f'{PACKAGES}/ament_index_python/search_paths.py', _import_pathlib_when_needed),
    (f'{PACKAGES}/rosidl_generator_py/__init__.py', _import_when_needed),
    (f'{PACKAGES}/rosidl_parser/parser.py', _keep_parsed),
    (f'{PACKAGES}/rosidl_pycommon/__init__.py', _read_templates_once),
    (f'{PACKAGES}/rpyutils/import_c_library.py', _import_pathlib_for_errors),
    (f'{PACKAGES}/rclpy/context.py', _shut_down_after_signal),
    (f'{PACKAGES}/rclpy/executors.py', _end_with_context),
    (f'{PACKAGES}/rclpy/logging.py', _import_in_functions(PATH_IMPORT, PATH_USE)),
    (f'{PACKAGES}/rclpy/parameter.py', _import_in_functions(YAML_IMPORT, *YAML_USES)),
    (f'{PACKAGES}/rclpy/action/client.py', _note_requests_first),
    (f'{PACKAGES}/viser/infra/_async_message_buffer.py', _wake_event_loop),
    ('bin/xacro', _say_where),
    ('bin/activate', _activate_ros),
)
NOT_EVERYWHERE = (f'{PACKAGES}/cmeel.pth',)  # comes with what only tests need


def is_mended(environment: Path, path: Path) -> bool:
    """
    Whether mending changes a file, so that its size may differ from the one its wheel records.

    Parameters
    ----------
    environment
        The prefix of the wheels.
    path
        A file in it.

    """
    relative = os.path.relpath(path, environment)
    return any(fnmatchcase(relative, pattern) for pattern, _ in MENDED)


def mend_wheels(environment: Path, include: str, site_packages: Path) -> None:
    """
    Patch the files of installed wheels; harmless where they are patched already.

    Parameters
    ----------
    environment
        The prefix of the wheels.
    include
        The folder with Python.h.
    site_packages
        The environment's own.

    Raises
    ------
    FileNotFoundError
        A wheel lacks a file that was to be patched.
    SetupError
        Such a file is not as expected.

    """
    numpy_headers = str(site_packages / 'numpy' / '_core' / 'include')
    interpreter = Interpreter(include, numpy_headers, site_packages.parent.name)
    for pattern, mend in MENDED:
        paths = sorted(environment.glob(pattern))
        if not paths and '*.' not in pattern and pattern not in NOT_EVERYWHERE:
            raise FileNotFoundError(
                errno.ENOENT, 'a wheel lacks the file that was to be mended', environment / pattern
            )
        for path in paths:
            _rewrite(path, mend, interpreter)
    link_libraries(environment / 'lib', site_packages)


def _rewrite(path: Path, mend: Mend, interpreter: Interpreter) -> None:
    """Replace a file by its mended text in one step, so that no half file is ever seen."""
    text = path.read_text(encoding='utf-8')
    try:
        changed = mend(text, interpreter)
    except UnexpectedTextError as error:
        raise SetupError(
            f'{path} is not the file that was to be mended: it lacks {str(error)!r}.\n'
            'The versions in requirements.txt fit this workspace: `make distclean setup` installs '
            'them. After a change of them, see tools/setup/mend.py.'
        ) from error
    if changed == text:
        return
    new = path.with_name(path.name + '.new')
    new.write_text(changed, encoding='utf-8')
    new.chmod(path.stat().st_mode)
    new.replace(path)


def link_libraries(library_folder: Path, site_packages: Path) -> None:
    """
    Link the libraries that wheels bring along into the folder of all libraries.

    Parameters
    ----------
    library_folder
        The folder of all libraries, which is lib in the environment.
    site_packages
        The folder whose `ros_*.libs` contain the libraries.

    """
    for source in sorted(site_packages.glob('ros_*.libs/*.so*')):
        link = library_folder / source.name
        if not link.exists():
            link.unlink(missing_ok=True)
            link.symlink_to(os.path.relpath(source, library_folder))
