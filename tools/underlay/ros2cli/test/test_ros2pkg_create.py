# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 pkg create`."""

import ast
from pathlib import Path
import subprocess
import sys
from xml.etree import ElementTree

from ament_flake8.main import main_with_errors
from ament_pep257.main import main as pep257
import pytest
from ros2cli.cli import main

PYTHON = ['pkg', 'create', '--build-type', 'ament_python']
MAINTAINER = ['--maintainer-name', 'Ada', '--maintainer-email', 'ada@example.org']
EXPECTED = """\
going to create a new package
package name: arm_control
destination directory: {folder}
package format: 3
version: 0.0.0
description: TODO: Package description
maintainer: ['Ada <ada@example.org>']
licenses: ['Apache-2.0']
build type: ament_python
dependencies: ['rclpy', 'sensor_msgs']
node_name: mover
creating folder ./arm_control
creating ./arm_control/package.xml
creating source folder
creating folder ./arm_control/arm_control
creating ./arm_control/setup.py
creating ./arm_control/setup.cfg
creating folder ./arm_control/resource
creating ./arm_control/resource/arm_control
creating ./arm_control/arm_control/__init__.py
creating folder ./arm_control/test
creating ./arm_control/test/test_copyright.py
creating ./arm_control/test/test_flake8.py
creating ./arm_control/test/test_pep257.py
creating ./arm_control/arm_control/mover.py
creating ./arm_control/LICENSE
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make an empty folder the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_output_and_tree(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The output names each step in order, and each file that it names exists."""
    words = [
        *PYTHON,
        'arm_control',
        '--dependencies',
        'rclpy',
        'sensor_msgs',
        '--node-name',
        'mover',
        '--license',
        'Apache-2.0',
        *MAINTAINER,
    ]
    assert main(words) == 0
    output = capsys.readouterr().out
    assert output == EXPECTED.format(folder=folder)
    named = {Path(line.split()[-1]) for line in output.splitlines() if 'creating ./' in line}
    assert {path.relative_to(folder) for path in folder.rglob('*') if path.is_file()} == named


def test_options_may_follow_or_precede_the_name(folder: Path) -> None:
    """The order of options and name does not matter."""
    assert main(['pkg', 'create', 'first', '--build-type', 'ament_python']) == 0
    assert main([*PYTHON, 'second']) == 0
    files = [
        sorted(path.name for path in (folder / name / 'test').iterdir())
        for name in ('first', 'second')
    ]
    assert files[0] == files[1]


def test_manifest_declares_dependencies(folder: Path) -> None:
    """The manifest has format 3, the dependencies, the linters and escaped texts."""
    main([*PYTHON, 'p', '--description', 'a < b', '--dependencies', 'rclpy', 'std_msgs'])
    root = ElementTree.parse(folder / 'p' / 'package.xml').getroot()
    assert (root.get('format'), root.findtext('name')) == ('3', 'p')
    assert root.findtext('description') == 'a < b'
    assert [element.text for element in root.findall('depend')] == ['rclpy', 'std_msgs']
    assert [element.text for element in root.findall('test_depend')] == [
        'ament_copyright',
        'ament_flake8',
        'ament_pep257',
        'python3-pytest',
    ]
    assert root.findtext('export/build_type') == 'ament_python'


def test_created_sources_keep_the_style(folder: Path) -> None:
    """The linters find nothing in a new package, also with a long description and quotes."""
    main([*PYTHON, 'p', '--node-name', 'mover', '--description', 'It\'s a "robot" ' * 20])
    status, errors = main_with_errors(argv=[str(folder / 'p')])
    assert (status, errors) == (0, [])
    assert pep257(argv=[str(folder / 'p')]) == 0


def test_created_node_runs(folder: Path) -> None:
    """The node of a new package greets, and setup.py makes it an executable."""
    main([*PYTHON, 'p', '--node-name', 'mover'])
    result = subprocess.run(
        [sys.executable, '-m', 'p.mover'],
        cwd=folder / 'p',
        check=True,
        capture_output=True,
        text=True,
    )
    assert result.stdout == 'Hi from p.\n'
    setup_py = (folder / 'p' / 'setup.py').read_text()
    ast.parse(setup_py)
    assert "'mover = p.mover:main'," in setup_py


def test_unknown_license_is_a_warning(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The default licence is none; the output ends with the names of known ones."""
    assert main([*PYTHON, 'p']) == 0
    warning = capsys.readouterr().out.partition('\n\n')[2]
    assert warning.startswith("[WARNING]: Unknown license 'TODO: License declaration'.")
    assert warning.splitlines()[-1] == 'MIT-0'
    assert not (folder / 'p' / 'LICENSE').exists()


def test_known_license_is_written(folder: Path) -> None:
    """A known licence becomes a file with the holder's name."""
    main([*PYTHON, 'p', '--license', 'BSD-3-Clause', *MAINTAINER])
    text = (folder / 'p' / 'LICENSE').read_text()
    assert text.startswith('Copyright 2')
    assert 'Ada' in text.splitlines()[0]


def test_licenses_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    """A question mark lists the licences and creates nothing."""
    assert main(['pkg', 'create', '--license', '?', 'p']) == 0
    assert 'Apache-2.0' in capsys.readouterr().out.splitlines()
    assert not Path('p').exists()


def test_existing_folder_is_left_alone(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A folder that exists is not touched."""
    (folder / 'p').mkdir()
    assert main([*PYTHON, 'p']) == 1
    assert capsys.readouterr().err == (
        '\nAborted!\nThe directory already exists: ./p\nEither remove the directory or choose '
        'a different destination directory or package name\n'
    )
    assert list((folder / 'p').iterdir()) == []


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['test'], "cannot be named 'test'"),
        (['my-pkg'], "package 'my-pkg' is not a valid Python module name"),
        (
            ['bad name'],
            "'bad name' is not a valid package name: use letters, digits and underscores",
        ),
        (['1x'], "'1x' is not a valid package name"),
        (['_x'], "with a letter first, for example 'n_x'"),
        (['class'], "package 'class' cannot be used: 'class' is a Python keyword"),
        (['json'], "package 'json' cannot be used: Python has a module 'json' of its own"),
        (['p', '--node-name', '2go'], "for example 'n2go'"),
        (['p', '--library-name', 'a b'], "for example 'a_b'"),
    ],
)
def test_names_that_cannot_work_are_refused(
    words: list[str],
    reason: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A name that would make a broken package is refused with the reason."""
    assert main([*PYTHON, *words]) == 1
    assert reason in capsys.readouterr().err
    assert not Path(words[0]).exists()


def test_path_is_no_name(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A path instead of a name is refused with the option that is meant."""
    assert main(['pkg', 'create', 'a/b']) == 1
    assert capsys.readouterr() == (
        '',
        "'a/b' is a path, not a package name. Give the folder in which to create the "
        'package with --destination-directory.\n',
    )
    assert list(folder.iterdir()) == []


def test_folder_that_cannot_be_created(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file in the way is named in a sentence."""
    (folder / 'p').touch()
    assert main([*PYTHON, 'p']) == 1
    output, errors = capsys.readouterr()
    assert output.endswith('creating folder ./p\n')
    assert errors == "cannot create './p': File exists\n"


def test_missing_name_explains_dependencies(capsys: pytest.CaptureFixture[str]) -> None:
    """A name swallowed by --dependencies is a usage error that says so."""
    assert main([*PYTHON, '--dependencies', 'rclpy', 'p']) == 2
    error = capsys.readouterr().err
    assert 'the following arguments are required: package_name' in error
    assert 'before --dependencies' in error


def test_node_named_like_library_is_renamed(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A node and a library of one name are told apart, with a warning."""
    assert main([*PYTHON, 'p', '--node-name', 'arm', '--library-name', 'arm']) == 0
    assert (folder / 'p' / 'p' / 'arm_node.py').is_file()
    assert (folder / 'p' / 'p' / 'arm' / '__init__.py').is_file()
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_cmake_package_has_its_files(folder: Path) -> None:
    """The default build type makes a C++ package with its node and dependencies."""
    assert main(['pkg', 'create', 'p', '--node-name', 'arm', '--dependencies', 'rclcpp']) == 0
    rules = (folder / 'p' / 'CMakeLists.txt').read_text()
    assert 'find_package(rclcpp REQUIRED)' in rules
    assert 'add_executable(arm src/arm.cpp)' in rules
    assert rules.endswith('ament_package()\n')
    assert (folder / 'p' / 'src' / 'arm.cpp').is_file()
    assert (folder / 'p' / 'include' / 'p').is_dir()


def test_plain_cmake_names_the_alternatives(capsys: pytest.CaptureFixture[str]) -> None:
    """A build type that is not supported is refused with those that are."""
    assert main(['pkg', 'create', 'p', '--build-type', 'cmake']) == 1
    assert '--build-type ament_python' in capsys.readouterr().err
