# SPDX-License-Identifier: Apache-2.0
"""Tests of the explanations for executables that are not found."""

from collections.abc import Callable
from pathlib import Path

import pytest
from ros_environment.workspace import explain_missing_executable

MakePackage = Callable[..., Path]

NODE = 'def main():\n    pass\n'
REBUILD = 'colcon build --packages-select arm && source install/setup.bash'
SCRIPTS = "entry_points={'console_scripts': ['wave = arm.waving:main', 'bend=arm.bend:main']}"


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    """Install a package with one executable."""
    folder = tmp_path / 'prefix' / 'lib' / 'arm'
    folder.mkdir(parents=True)
    (folder / 'bend').touch()
    (folder / 'bend').chmod(0o755)
    return tmp_path / 'prefix'


def test_module_without_entry_point(make_package: MakePackage, prefix: Path) -> None:
    """The line that setup.py lacks is printed, with the command that installs it."""
    folder = make_package('arm')
    (folder / 'arm' / 'joint_controller.py').write_text(NODE)
    lines = explain_missing_executable('arm', 'joint_controller', str(prefix)).splitlines()
    assert 'setup.py has no entry point for it. Add this line to the list ' in lines[0]
    assert lines[1] == "    'joint_controller = arm.joint_controller:main',"
    assert lines[2] == f'Then rebuild: {REBUILD}'
    assert lines[3] == "The executables of 'arm': bend."


def test_setup_without_any_entry_points(make_package: MakePackage, prefix: Path) -> None:
    """Without a list of scripts the whole keyword is printed."""
    folder = make_package('arm', entry_points='')
    (folder / 'arm' / 'wave.py').write_text(NODE)
    text = explain_missing_executable('arm', 'wave', str(prefix))
    assert "\n    entry_points={'console_scripts': ['wave = arm.wave:main']},\n" in text


def test_module_without_main(make_package: MakePackage, prefix: Path) -> None:
    """A module without a main function cannot be an entry point yet, which is said too."""
    folder = make_package('arm')
    (folder / 'arm' / 'wave.py').write_text('print()\n')
    assert "needs a function 'main()'" in explain_missing_executable('arm', 'wave', str(prefix))


def test_name_of_file_instead_of_executable(make_package: MakePackage, prefix: Path) -> None:
    """A file's name with its extension stands for the module."""
    folder = make_package('arm')
    (folder / 'arm' / 'wave.py').write_text(NODE)
    text = explain_missing_executable('arm', 'wave.py', str(prefix))
    assert "    'wave = arm.wave:main',\n" in text


def test_executable_with_another_name(make_package: MakePackage, prefix: Path) -> None:
    """A module whose entry point has another name leads to that name."""
    folder = make_package('arm', entry_points=SCRIPTS)
    (folder / 'arm' / 'waving.py').write_text(NODE)
    text = explain_missing_executable('arm', 'waving', str(prefix))
    assert "The module 'arm.waving' is the executable 'wave' in setup.py." in text


def test_declared_but_not_rebuilt(make_package: MakePackage, prefix: Path) -> None:
    """An entry point which is there but not installed needs a rebuild."""
    make_package('arm', entry_points=SCRIPTS)
    text = explain_missing_executable('arm', 'wave', str(prefix))
    assert "declares 'wave'" in text
    assert f'Rebuild: {REBUILD}' in text


def test_misspelt_name(make_package: MakePackage, prefix: Path) -> None:
    """A misspelt name is answered with the closest one."""
    make_package('arm')
    assert explain_missing_executable('arm', 'bent', str(prefix)) == (
        "The executables of 'arm': bend. Did you mean 'bend'?"
    )


def test_installed_to_the_wrong_folder(make_package: MakePackage, tmp_path: Path) -> None:
    """A script in `bin` means that setup.cfg lacks the folder for scripts."""
    make_package('arm', entry_points=SCRIPTS)
    (tmp_path / 'prefix' / 'bin').mkdir(parents=True)
    (tmp_path / 'prefix' / 'bin' / 'wave').touch()
    text = explain_missing_executable('arm', 'wave', str(tmp_path / 'prefix'))
    assert '    [install]\n    install_scripts=$base/lib/arm\n' in text


def test_setup_is_never_executed(make_package: MakePackage, prefix: Path) -> None:
    """A setup.py is only read, also when it cannot be parsed."""
    folder = make_package('arm')
    (folder / 'setup.py').write_text("raise SystemExit('executed')\n")
    assert 'bend' in explain_missing_executable('arm', 'wave', str(prefix))
    (folder / 'setup.py').write_text('setup(')
    assert 'bend' in explain_missing_executable('arm', 'wave', str(prefix))
