# SPDX-License-Identifier: Apache-2.0
"""What the program writes and what it says."""

from __future__ import annotations

import os
from pathlib import Path
import subprocess
import sys

import pytest
import xacro
from xacro_program import main

MODEL = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="scale" default="1"/>
  <xacro:macro name="leg" params="side"><link name="${side}_$(arg scale)"/></xacro:macro>
  <xacro:leg side="left"/>
  <xacro:leg side="right"/>
  <xacro:if value="$(arg scale)"><a>&lt;${'é'} {}</a></xacro:if>
  <xacro:unless value="1"><b x="$(arg inner)"/></xacro:unless>
</robot>
"""


@pytest.fixture(autouse=True)
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write a model to the current folder."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / 'model.xacro'
    path.write_text(MODEL, encoding='utf-8')
    return path


def test_result_is_that_of_xacro(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The output is what the module itself makes."""
    assert main(['model.xacro', 'scale:=2']) == 0
    out, err = capsys.readouterr()
    made = xacro.process_file('model.xacro', mappings={'scale': '2'}).toprettyxml(indent='  ')
    assert (out, err) == (made, '')
    assert '<link name="left_2"/>' in out


def test_misspelt_argument(capsys: pytest.CaptureFixture[str]) -> None:
    """An argument that changes nothing is a hint; the result is there all the same."""
    assert main(['model.xacro', 'scal:=2']) == 0
    out, err = capsys.readouterr()
    assert '<link name="left_1"/>' in out
    assert err == (
        "xacro: hint: no <xacro:arg> declares 'scal', so it has no effect. Did you mean 'scale'?\n"
    )


def test_foreign_argument(capsys: pytest.CaptureFixture[str]) -> None:
    """Where no name is close, those that there are are listed."""
    assert main(['model.xacro', 'colour:=red']) == 0
    assert capsys.readouterr().err.endswith('has no effect. The arguments are: scale\n')


def test_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    """-q leaves the hint out."""
    assert main(['model.xacro', 'scal:=2', '-q']) == 0
    assert capsys.readouterr().err == ''


def test_used_but_not_declared(capsys: pytest.CaptureFixture[str], model: Path) -> None:
    """An argument that is only used is no mistake."""
    model.write_text('<a x="$(arg b)" xmlns:xacro="http://www.ros.org/wiki/xacro"/>')
    assert main(['model.xacro', 'b:=2']) == 0
    assert capsys.readouterr().err == ''


def test_output_file(capsys: pytest.CaptureFixture[str]) -> None:
    """-o makes the file and its folder, and keeps the permissions of a file that is there."""
    path = Path('new', 'robot.urdf')
    assert main(['model.xacro', '-o', str(path)]) == 0
    assert '<link name="right_1"/>' in path.read_text(encoding='utf-8')
    path.chmod(0o640)
    assert main(['model.xacro', '-o', str(path), 'scale:=3']) == 0
    assert '<link name="right_3"/>' in path.read_text(encoding='utf-8')
    assert path.stat().st_mode & 0o777 == 0o640
    assert capsys.readouterr() == ('', '')
    assert os.listdir('new') == ['robot.urdf']


def test_no_half_output(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An error leaves the file of -o, and folders that are not there, as they are."""
    model.write_text(MODEL.replace('${side}', '${sied}'))
    Path('robot.urdf').write_text('old')
    for path in ('robot.urdf', 'new/robot.urdf'):
        assert main(['model.xacro', '-o', path]) == 1
    assert Path('robot.urdf').read_text() == 'old'
    assert not Path('new').exists()
    assert capsys.readouterr().err.count("Did you mean 'side'?") == 2


def test_unwritable_output(capsys: pytest.CaptureFixture[str]) -> None:
    """An output that cannot be written is one line and status 1."""
    assert main(['model.xacro', '-o', '/proc/no/robot.urdf']) == 1
    assert capsys.readouterr().err.startswith("xacro: error: cannot write '/proc/no/robot.urdf': ")


def test_device_as_output(capfd: pytest.CaptureFixture[str]) -> None:
    """What is no regular file is written to, not replaced."""
    assert main(['model.xacro', '-o', '/dev/null']) == 0
    assert not Path('/dev/null').is_file()


def test_dependencies(capsys: pytest.CaptureFixture[str], model: Path) -> None:
    """--deps lists the files that are included."""
    Path('b.xacro').write_text('<a/>')
    head, rest = MODEL.split('\n', 1)
    model.write_text(f'{head}<xacro:include filename="b.xacro"/>{rest}')
    xacro.all_includes.clear()
    assert main(['model.xacro', '--deps']) == 0
    assert capsys.readouterr().out == 'b.xacro'


@pytest.mark.parametrize('arguments', [[], ['a', 'b'], ['a', '--no-such-option']])
def test_usage(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """A wrong command line has status 2."""
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert capsys.readouterr().out == ''


def test_bad_argument(capsys: pytest.CaptureFixture[str]) -> None:
    """An argument with two signs is refused in one line, with status 2."""
    assert main(['model.xacro', 'a:=b:=c']) == 2
    err = capsys.readouterr().err
    assert err == "xacro: error: Invalid remapping argument 'a:=b:=c': expected NAME:=VALUE\n"


def test_program() -> None:
    """As a process it writes the model; a reader that leaves is no error to be told."""
    command = [sys.executable, '-m', 'xacro_program', 'model.xacro']
    result = subprocess.run(command, capture_output=True, encoding='utf-8')
    assert (result.returncode, result.stderr) == (0, '')
    assert '<link name="left_1"/>' in result.stdout


def test_closed_pipe(model: Path) -> None:
    """A reader that has gone is no traceback."""
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, '-m', 'xacro_program', 'model.xacro']
    result = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, encoding='utf-8')
    os.close(write)
    assert (result.returncode, result.stderr) == (1, '')
