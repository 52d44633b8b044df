# SPDX-License-Identifier: Apache-2.0
"""Tests of the wheels' completeness and of what is mended in them."""

from __future__ import annotations

import os
from pathlib import Path
import re
import subprocess
import sys

from console import SetupError
from locations import Locations
from mend import link_libraries, mend_wheels
import pytest
from wheels import compile_all, incomplete_distributions, pinned_names

INDEX = """\
# A comment before the first import.

import os
import pathlib
import re
from typing import Dict
import warnings


def prefixes() -> Dict[str, str]:
    return {'re': re.__name__, 'os': os.name, 'warnings': warnings.__name__}


def share_path(name: str) -> pathlib.Path:
    path = pathlib.Path(name)
    return path
"""

LIBRARIES = """\
import os
from pathlib import Path


def load(name: str):
    try:
        return __import__(name)
    except ImportError as e:
        raise ImportError(str(Path(os.sep) / name)) from e
"""

PARSER = """\
import os


def parse_idl_file(locator, png_file=None):
    print('parsed')
    return locator.get_absolute_path().read_text()


def find(node, target):
    if node == target:
        return node
"""

TEMPLATE = """\
@# A comment, an @@ and what follows
@{
import os
names = [name.strip() for name in 'a, b, c'.split(',')]
}@
@[for name in names]@
@[  if name == first]@
@( name.upper() )@("!" if name else "")
@[  elif name == 'b']@
@(name)
@[  else]@
@{ kept.append(name) }@
other@
@[  end if]@
@[end for]@
@(len(kept)) @(os.sep) @[if first]end@[end if]"""

EXPAND = """\
import sys, io
{imported}
import em
template = sys.stdin.read()
for first in ('a', 'c', 'a'):
    output = io.StringIO()
    options = {{em.BUFFERED_OPT: True, em.RAW_OPT: True}}
    interpreter = em.Interpreter(output=output, options=options)
    interpreter.string(template, 'template', locals={{'first': first, 'kept': []}})
    print(output.getvalue())
    interpreter.shutdown()
"""

CMAKE = """\
cmake_minimum_required(VERSION 3.20)
project(demo)
include("{generators}")
set(AMENT_EXTENSIONS_rosidl_generate_idl_interfaces
  rosidl_typesupport_c:c.cmake rosidl_generator_cpp:cpp.cmake rosidl_typesupport_cpp:cpp.cmake)
macro(ament_execute_extensions point)
  message("generators: ${{AMENT_EXTENSIONS_${{point}}}}")
  file(WRITE one__description.c "")
  file(WRITE one__functions.c "")
  add_library(demo__rosidl_generator_c one__description.c one__functions.c)
endmacro()
rosidl_generate_interfaces(demo)
get_target_property(unity demo__rosidl_generator_c UNITY_BUILD)
get_source_file_property(alone one__description.c SKIP_UNITY_BUILD_INCLUSION)
get_source_file_property(together one__functions.c SKIP_UNITY_BUILD_INCLUSION)
message("unity: ${{unity}} ${{alone}} ${{together}}")
"""


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    """Return a folder of packages with one distribution."""
    folder = tmp_path / 'lib' / 'python3.12' / 'site-packages'
    info = folder / 'demo-1.2.dist-info'
    info.mkdir(parents=True)
    (folder / 'demo.py').write_text('12345')
    (info / 'RECORD').write_text('demo.py,sha256=x,5\ndemo-1.2.dist-info/RECORD,,\n')
    return folder


def test_a_whole_distribution_is_left_alone(tmp_path: Path, packages: Path) -> None:
    """All files of the list are there."""
    assert list(incomplete_distributions(packages, tmp_path)) == []


def test_what_an_interruption_leaves_is_found(tmp_path: Path, packages: Path) -> None:
    """A missing file, a cut one and a missing list each make a distribution incomplete."""
    (packages / 'demo.py').write_text('123')
    assert list(incomplete_distributions(packages, tmp_path)) == ['demo==1.2']
    (packages / 'demo.py').unlink()
    assert list(incomplete_distributions(packages, tmp_path)) == ['demo==1.2']
    (packages / 'demo.py').write_text('12345')
    (packages / 'demo-1.2.dist-info' / 'RECORD').unlink()
    assert list(incomplete_distributions(packages, tmp_path)) == ['demo==1.2']


def test_what_is_mended_is_not_taken_for_incomplete(tmp_path: Path, packages: Path) -> None:
    """A second look, as for what tests need, does not install mended wheels anew."""
    write_wheels(tmp_path, packages)
    record = packages / 'demo-1.2.dist-info' / 'RECORD'
    record.unlink()
    files = [path for path in tmp_path.rglob('*') if path.is_file()]
    rows = [f'{os.path.relpath(path, packages)},,{path.stat().st_size}\n' for path in files]
    record.write_text(''.join(rows))
    mend_wheels(tmp_path, '', packages)
    assert list(incomplete_distributions(packages, tmp_path)) == []


def test_every_requirement_is_pinned(root: Path) -> None:
    """No line of requirements.txt leaves a version open."""
    text = (root / 'requirements.txt').read_text()
    lines = [line for line in text.splitlines() if line and not line.startswith('#')]
    assert len(pinned_names(text)) == len(lines) > 100


def test_cmake_files_name_the_python_at_hand(tmp_path: Path, packages: Path) -> None:
    """The build machine's Python is replaced, and a second mending changes nothing."""
    write_wheels(tmp_path, packages)
    exported = tmp_path / 'share' / 'std_msgs' / 'cmake' / 'export.cmake'
    exported.parent.mkdir(parents=True)
    exported.write_text(
        '"/opt/python/cp312-cp312/include/python3.12;/opt/python/x/numpy/_core/include"'
    )
    for _ in range(2):
        mend_wheels(tmp_path, '/usr/include/python3.12', packages)
        assert exported.read_text() == (
            f'"/usr/include/python3.12;{packages}/numpy/_core/include"'
        )
        adapter = tmp_path / 'share/rosidl_adapter/cmake/rosidl_adapt_interfaces.cmake'
        assert 'ENCODING UTF-8' in adapter.read_text()
        hook = packages / 'ros_wheels_bootstrapper.pth'
        assert '_ROS_WHEELS_BOOTSTRAP_COMPLETE' in hook.read_text()
        xacro = tmp_path / 'bin' / 'xacro'
        program = 'import sys\nfrom xacro_program import main\nsys.exit(main())\n'
        assert xacro.read_text() == program
        assert os.access(xacro, os.X_OK)


def test_activation_sources_the_environment(tmp_path: Path, packages: Path) -> None:
    """Who activates the environment as Python users do has the variables of ROS too."""
    write_wheels(tmp_path, packages)
    (tmp_path / 'setup.bash').write_text('export AMENT_PREFIX_PATH=/here')
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    activate = tmp_path / 'bin' / 'activate'
    assert activate.read_text().count('What ROS needs') == 1
    result = subprocess.run(
        ['bash', '-euc', f'. "{activate}"; echo "$AMENT_PREFIX_PATH"'],
        capture_output=True,
        text=True,
        check=True,
    )
    assert result.stdout == '/here\n'


def write_wheels(environment: Path, packages: Path) -> None:
    """Write the files that are mended, as the wheels and Python bring them."""
    (packages / 'ros_wheels_bootstrapper.pth').write_text('import ros_wheels_bootstrapper')
    adapter = environment / 'share/rosidl_adapter/cmake/rosidl_adapt_interfaces.cmake'
    adapter.parent.mkdir(parents=True)
    adapter.write_text('file(STRINGS "${idl_output}" idl_tuples)')
    generators = environment / 'share/rosidl_cmake/cmake/rosidl_generate_interfaces.cmake'
    generators.parent.mkdir(parents=True)
    generators.write_text(
        'macro(rosidl_generate_interfaces target)\n'
        '  ament_execute_extensions("rosidl_generate_idl_interfaces")\nendmacro()\n'
    )
    command = environment / 'share/rosidl_generator_py/cmake/custom_command.cmake'
    command.parent.mkdir(parents=True)
    command.write_text('  DEPENDS ${target_dependencies} ${rosidl_generate_interfaces_TARGET}\n')
    command.with_name('rosidl_generator_py_generate_interfaces.cmake').write_text(
        'rosidl_generator_py_get_typesupports(_typesupport_impls)\n'
        'message(STATUS "modules: ${_typesupport_impls}")\n'
    )
    activate = environment / 'bin' / 'activate'
    activate.parent.mkdir()
    activate.write_text(f'VIRTUAL_ENV={environment}\n')
    program = 'import sys\nfrom xacro import main\nsys.exit(main())\n'
    xacro = environment / 'bin' / 'xacro'
    xacro.write_text(program)
    xacro.chmod(0o755)
    context = packages / 'rclpy' / 'context.py'
    context.parent.mkdir()
    context.write_text('class Context:\n    shutdown = try_shutdown = len\n')
    (packages / 'rclpy' / 'logging.py').write_text(
        'import re\nfrom pathlib import Path\n\n\ndef folder() -> Path:\n    return Path("x")\n'
    )
    (packages / 'rclpy' / 'parameter.py').write_text(
        'import re\nimport yaml\n\n\ndef value(text):\n    try:\n'
        '        yaml_value = yaml.safe_load(text)\n    except yaml.YAMLError:\n'
        '        yaml_value = text\n    return yaml_value\n\n\ndef file(text):\n    if text:\n'
        '        param_file = yaml.safe_load(text)\n'
    )
    (packages / 'yaml.py').write_text('YAMLError = ValueError\nsafe_load = int\n')
    (packages / 'rclpy' / 'executors.py').write_text(
        'import re\nfrom concurrent.futures import ThreadPoolExecutor\n\n\nclass Pool:\n'
        '    def __init__(self):\n        self._executor = ThreadPoolExecutor(2)\n\n'
        '    def wait(self, wait_set):\n        with wait_set:\n            if wait_set.wait():\n'
        "                guards_ready = wait_set.get_ready_entities('guard_condition')\n"
        '\n\nclass Executor:\n    wait_for_ready_callbacks = len\n'
    )
    client = packages / 'rclpy' / 'action' / 'client.py'
    client.parent.mkdir()
    client.write_text('import threading\n\n\nclass ActionClient:\n    take_data = len\n')
    messages = packages / 'viser' / 'infra' / '_async_message_buffer.py'
    messages.parent.mkdir(parents=True)
    messages.write_text(
        '            self.message_event.set()\n            if self.atomic_counter == 0:'
    )
    (packages / 'cmeel.pth').write_text('import cmeel_pth')
    linter = packages / 'ament_flake8' / 'configuration' / 'ament_flake8.ini'
    linter.parent.mkdir(parents=True)
    linter.write_text('[flake8]\nstatistics = true\n')
    index = packages / 'ament_index_python'
    index.mkdir()
    (index / '__init__.py').touch()
    for name in ('resources', 'search_paths'):
        (index / f'{name}.py').write_text('import os\nfrom typing import Dict\n\n\nuse = Dict\n')
    (index / 'packages.py').write_text(INDEX)
    parser = packages / 'rosidl_parser' / 'parser.py'
    parser.parent.mkdir()
    parser.write_text(PARSER)
    (parser.parent / '__init__.py').touch()
    common = packages / 'rosidl_pycommon' / '__init__.py'
    common.parent.mkdir()
    common.write_text('import em\n\nem_has_configuration = False\n')
    libraries = packages / 'rpyutils' / 'import_c_library.py'
    libraries.parent.mkdir()
    libraries.write_text(LIBRARIES)
    generator = packages / 'rosidl_generator_py'
    generator.mkdir()
    (generator / 'generate_py_impl.py').write_text("print('loaded')\ngenerate_py = len\n")
    (generator / '__init__.py').write_text(
        'try:\n'
        '    from .generate_py_impl import generate_py\n'
        '    assert generate_py\n'
        'except ImportError:\n'
        '    pass\n'
    )


@pytest.mark.parametrize(
    ('path', 'lacks'),
    [
        ('rclpy/executors.py', 'guard_condition'),
        ('rclpy/logging.py', 'return Path('),
        ('rosidl_generator_py/__init__.py', 'generate_py_impl'),
        ('ament_index_python/packages.py', 'import'),
        ('viser/infra/_async_message_buffer.py', 'message_event'),
    ],
)
def test_another_text_is_not_mended(tmp_path: Path, packages: Path, path: str, lacks: str) -> None:
    """A file that another version changed is named, with what it lacks, and is left as it is."""
    write_wheels(tmp_path, packages)
    other = packages / path
    before = 'x = 1\n        self._executor = ThreadPoolExecutor(1)\n'
    other.write_text(before)
    with pytest.raises(SetupError, match=f'{other} is not the file.*{re.escape(lacks)}'):
        mend_wheels(tmp_path, '', packages)
    assert other.read_text() == before


def test_shutdown_after_a_signal_is_added_once(tmp_path: Path, packages: Path) -> None:
    """rclpy's own methods are kept, and wrapped no second time."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    text = (packages / 'rclpy' / 'context.py').read_text()
    assert text.startswith('class Context') and text.count('_shut_down_by_call = False') == 1


def test_the_end_with_the_context_is_added_once(tmp_path: Path, packages: Path) -> None:
    """rclpy's own executor is kept, and wrapped no second time."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    text = (packages / 'rclpy' / 'executors.py').read_text()
    assert text.count('class Executor') == 1 and text.count('def _wait_or_end') == 1
    assert text.count('guards_ready = ') == text.count('in guards_ready') == 1


def test_answers_after_requests_are_added_once(tmp_path: Path, packages: Path) -> None:
    """rclpy's own action client is kept, and wrapped no second time."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    text = (packages / 'rclpy' / 'action' / 'client.py').read_text()
    assert 'class ActionClient:' in text and text.count('def _in_turn') == 1
    assert text.count('import functools') == 1


def test_rclpy_imports_where_it_uses(tmp_path: Path, packages: Path) -> None:
    """What needs pathlib or a pool of threads still has it; others do not load it."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    code = (
        f'import sys; sys.path.insert(0, {str(packages)!r})\n'
        'import rclpy.executors, rclpy.logging, rclpy.parameter\n'
        "assert not {'concurrent.futures', 'pathlib', 'yaml'} & set(sys.modules)\n"
        'print(rclpy.logging.folder(), rclpy.executors.Pool()._executor._max_workers, '
        "rclpy.parameter.value('3'), rclpy.parameter.value('x'))"
    )
    done = subprocess.run([sys.executable, '-ISc', code], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ('x 2 3 x\n', '')


def test_generator_is_loaded_when_it_is_used(tmp_path: Path, packages: Path) -> None:
    """Whoever imports the package does not load the generator, and yet can use it."""
    write_wheels(tmp_path, packages)
    mend_wheels(tmp_path, '', packages)
    code = (
        "import rosidl_generator_py; print('imported')\n"
        'from rosidl_generator_py import generate_py; print(generate_py([]))\n'
        "print(hasattr(rosidl_generator_py, 'other'))"
    )
    result = subprocess.run(
        [sys.executable, '-c', code], cwd=packages, capture_output=True, text=True, check=True
    )
    assert result.stdout.split() == ['imported', 'loaded', '0', 'False']


def test_index_of_packages_is_read_without_pathlib(tmp_path: Path, packages: Path) -> None:
    """What is imported for annotations alone, or for one function, comes when it is needed."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    code = (
        'import sys; sys.modules.pop("pathlib", None)\n'
        'from ament_index_python import packages\n'
        "print(sorted(packages.prefixes()), 'pathlib' in sys.modules, packages.share_path('a'))\n"
    )
    result = subprocess.run(
        [sys.executable, '-c', code], cwd=packages, capture_output=True, text=True, check=True
    )
    assert result.stdout == "['os', 're', 'warnings'] False a\n"


@pytest.mark.parametrize(
    ('option', 'generators', 'unity'),
    [
        ([], 'rosidl_typesupport_c:c.cmake', 'ON ON NOTFOUND'),
        (
            ['-DROSIDL_GENERATE_CPP=ON', '-DCMAKE_UNITY_BUILD=OFF'],
            'rosidl_typesupport_c:c.cmake;rosidl_generator_cpp:cpp.cmake;'
            'rosidl_typesupport_cpp:cpp.cmake',
            'OFF NOTFOUND NOTFOUND',
        ),
    ],
)
def test_interfaces_are_made_for_python(
    tmp_path: Path, packages: Path, option: list[str], generators: str, unity: str
) -> None:
    """C++ comes when it is asked for; sources are compiled together unless somebody objects."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    script = tmp_path / 'share/rosidl_cmake/cmake/rosidl_generate_interfaces.cmake'
    (tmp_path / 'CMakeLists.txt').write_text(CMAKE.format(generators=script))
    command = ['cmake', '-S', tmp_path, '-B', tmp_path / 'build', *option]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert f'generators: {generators}\n' in result.stderr
    assert f'unity: {unity}\n' in result.stderr
    assert ('without C++' in result.stdout) == (not option)


def test_one_python_module_is_compiled(tmp_path: Path, packages: Path) -> None:
    """It is the one that rclpy loads, whatever there is besides."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    folder = tmp_path / 'share/rosidl_generator_py/cmake'
    script = tmp_path / 'script.cmake'
    script.write_text(
        'macro(rosidl_generator_py_get_typesupports var)\n  set(${var} a rosidl_typesupport_c)\n'
        f'endmacro()\ninclude("{folder}/rosidl_generator_py_generate_interfaces.cmake")\n'
    )
    result = subprocess.run(['cmake', '-P', script], capture_output=True, text=True, check=True)
    assert result.stdout == '-- modules: rosidl_typesupport_c\n'


def test_an_interface_is_parsed_once(tmp_path: Path, packages: Path) -> None:
    """What was read is kept beside the file, and read anew where the file is another one."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    code = (
        'from pathlib import Path\nfrom types import SimpleNamespace\n'
        'from rosidl_parser.parser import parse_idl_file\n'
        'path = Path("one.idl")\nlocator = SimpleNamespace(get_absolute_path=lambda: path)\n'
        'for text in ("a", "a", "b", "b"):\n    path.write_text(text)\n'
        '    print(parse_idl_file(locator))\n'
        'Path("one.idl.parsed").write_text("broken")\nprint(parse_idl_file(locator))\n'
    )
    result = subprocess.run(
        [sys.executable, '-c', code], cwd=packages, capture_output=True, text=True, check=True
    )
    assert result.stdout.split() == ['parsed', 'a', 'a', 'parsed', 'b', 'b', 'parsed', 'b']


def test_templates_are_expanded_as_before(tmp_path: Path, packages: Path) -> None:
    """That a template is read once changes nothing of what it makes, each time."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    outputs = []
    for imported in ('', 'import rosidl_pycommon'):
        command = [sys.executable, '-c', EXPAND.format(imported=imported)]
        done = subprocess.run(
            command, cwd=packages, input=TEMPLATE, capture_output=True, text=True, check=True
        )
        outputs.append(done.stdout)
    assert outputs[0] == outputs[1]
    assert outputs[0].startswith('A!\nb\nother1 / end\nother') and len(outputs[0]) > 30


def test_libraries_are_loaded_without_pathlib(tmp_path: Path, packages: Path) -> None:
    """It is imported where a library cannot be loaded, for the text of the error."""
    write_wheels(tmp_path, packages)
    (packages / 'rpyutils' / '__init__.py').touch()
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    code = (
        'import sys; sys.modules.pop("pathlib", None)\n'
        'from rpyutils.import_c_library import load\n'
        "print(load('os').sep, 'pathlib' in sys.modules)\n"
        "try: load('missing')\nexcept ImportError as error: print(error)\n"
    )
    result = subprocess.run(
        [sys.executable, '-c', code], cwd=packages, capture_output=True, text=True, check=True
    )
    assert result.stdout == '/ False\n/missing\n'


def test_only_wheels_of_tests_may_be_missing(tmp_path: Path, packages: Path) -> None:
    """The libraries of the tests may be missing; of another wheel the file is named."""
    write_wheels(tmp_path, packages)
    (packages / 'cmeel.pth').unlink()
    mend_wheels(tmp_path, '', packages)
    (packages / 'rclpy' / 'context.py').unlink()
    with pytest.raises(FileNotFoundError) as failure:
        mend_wheels(tmp_path, '', packages)
    assert str(failure.value.filename).endswith('rclpy/context.py')
    assert 'a wheel lacks the file' in str(failure.value.strerror)


def test_folder_of_cmeel_is_found(tmp_path: Path, packages: Path) -> None:
    """The folder is added by its name, by whichever Python reads the line."""
    write_wheels(tmp_path, packages)
    mend_wheels(tmp_path, '', packages)
    folder = packages / 'cmeel.prefix' / 'lib' / 'python3.12' / 'site-packages'
    folder.mkdir(parents=True)
    code = f'import site, sys; site.addsitedir({str(packages)!r}); print(sys.path[-1])'
    result = subprocess.run(
        [sys.executable, '-c', code],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, '_ROS_WHEELS_BOOTSTRAP_COMPLETE': '1'},
    )
    assert result.stdout == f'{folder}\n'


def test_all_modules_are_compiled(tmp_path: Path, packages: Path) -> None:
    """Also where one among them cannot be, as the tests of some wheels."""
    (packages / 'demo').mkdir()
    (packages / 'demo' / 'good.py').write_text('number = 1\n')
    (packages / 'broken.py').write_text('number =\n')
    (tmp_path / 'bin').mkdir()
    (tmp_path / 'bin' / 'python3').symlink_to(sys.executable)
    compile_all(Locations(tmp_path, tmp_path, tmp_path))
    assert [path.name.split('.')[0] for path in packages.rglob('*.pyc')].count('good') == 1


def test_bundled_libraries_are_linked(tmp_path: Path, packages: Path) -> None:
    """One folder holds all libraries; a link that leads nowhere is replaced."""
    bundled = packages / 'ros_demo.libs' / 'libdemo.so.1'
    bundled.parent.mkdir()
    bundled.write_text('library')
    (tmp_path / 'lib' / 'libdemo.so.1').symlink_to('nowhere')
    link_libraries(tmp_path / 'lib', packages)
    assert (tmp_path / 'lib' / 'libdemo.so.1').read_text() == 'library'


def test_linter_forks_nobody(tmp_path: Path) -> None:
    """It runs in test processes, beside threads whose locks a forked process would wait for."""
    for name in 'ab':
        (tmp_path / f'{name}.py').write_text('x = 1\n')
    code = (
        'import os, sys; os.fork = None; from ament_flake8.main import main; sys.exit(main([])) '
    )
    result = subprocess.run(
        [sys.executable, '-c', code], cwd=tmp_path, capture_output=True, text=True
    )
    assert result.returncode == 0, result.stderr
    assert '2 files checked' in result.stdout
