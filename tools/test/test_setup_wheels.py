# SPDX-License-Identifier: Apache-2.0
"""Tests of the wheels' completeness and of what is mended in them."""

from __future__ import annotations

import os
from pathlib import Path
import subprocess
import sys

from mend import link_libraries, mend_wheels
import pytest
from wheels import incomplete_distributions, pinned_names

VISER = """\
    def push(self, message):
        with self.buffer_lock:
            self.message_event.set()
            if self.atomic_counter == 0:
                self.event_loop.call_soon_threadsafe(self.message_event.set)
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


def test_a_whole_distribution_is_left_alone(packages: Path) -> None:
    """All files of the list are there."""
    assert list(incomplete_distributions(packages)) == []


def test_what_an_interruption_leaves_is_found(packages: Path) -> None:
    """A missing file, a cut one and a missing list each make a distribution incomplete."""
    (packages / 'demo.py').write_text('123')
    assert list(incomplete_distributions(packages)) == ['demo==1.2']
    (packages / 'demo.py').unlink()
    assert list(incomplete_distributions(packages)) == ['demo==1.2']
    (packages / 'demo.py').write_text('12345')
    (packages / 'demo-1.2.dist-info' / 'RECORD').unlink()
    assert list(incomplete_distributions(packages)) == ['demo==1.2']


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
    activate = environment / 'bin' / 'activate'
    activate.parent.mkdir()
    activate.write_text(f'VIRTUAL_ENV={environment}\n')
    program = 'import sys\nfrom xacro import main\nsys.exit(main())\n'
    xacro = environment / 'bin' / 'xacro'
    xacro.write_text(program)
    xacro.chmod(0o755)
    (packages / 'viser' / 'infra').mkdir(parents=True)
    (packages / 'viser' / 'infra' / '_async_message_buffer.py').write_text(VISER)
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


def test_event_of_a_loop_is_set_in_it(tmp_path: Path, packages: Path) -> None:
    """Not from another thread, where nobody would be woken."""
    write_wheels(tmp_path, packages)
    for _ in range(2):
        mend_wheels(tmp_path, '', packages)
    buffer = packages / 'viser' / 'infra' / '_async_message_buffer.py'
    assert buffer.read_text() == VISER.replace('            self.message_event.set()\n', '', 1)


def test_bundled_libraries_are_linked(tmp_path: Path, packages: Path) -> None:
    """One folder holds all libraries; a link that leads nowhere is replaced."""
    bundled = packages / 'ros_demo.libs' / 'libdemo.so.1'
    bundled.parent.mkdir()
    bundled.write_text('library')
    (tmp_path / 'lib' / 'libdemo.so.1').symlink_to('nowhere')
    link_libraries(tmp_path / 'lib', packages)
    assert (tmp_path / 'lib' / 'libdemo.so.1').read_text() == 'library'
