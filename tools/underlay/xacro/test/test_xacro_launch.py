# SPDX-License-Identifier: Apache-2.0
"""Launch files show what xacro says."""

from __future__ import annotations

from pathlib import Path
import shlex
import sys

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess
from launch.substitutions import Command
import pytest

PROGRAM = f'{shlex.quote(sys.executable)} -m xacro_program '
HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


@pytest.fixture(autouse=True)
def log_dir(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path / 'log'))


def launch(arguments: str) -> int:
    """Launch two processes; the second one's name depends on what xacro makes."""
    expanded = Command(PROGRAM + arguments)
    service = LaunchService(noninteractive=True)
    service.include_launch_description(
        LaunchDescription(
            [
                ExecuteProcess(cmd=['touch', 'first']),
                ExecuteProcess(cmd=['touch', 'second'], additional_env={'MODEL': expanded}),
            ]
        )
    )
    return service.run()


@pytest.mark.parametrize(
    ('file', 'sentence'),
    [
        ('model.xacro', "model.xacro:2:7: error: in ${b}: name 'b' is not defined"),
        ('modell.xacro', "modell.xacro: error: the file 'modell.xacro' does not exist. Did you "),
    ],
)
def test_error(file: str, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    """An error is shown once, without a traceback, and nothing is started."""
    Path('model.xacro').write_text(f'{HEAD}<a x="${{b}}"/></robot>')
    assert launch(file) == 1
    out, err = capsys.readouterr()
    assert (out + err).count(sentence) == 1
    assert 'Traceback' not in out + err
    assert not Path('first').exists()


def test_misspelt_argument(capsys: pytest.CaptureFixture[str]) -> None:
    """An argument that changes nothing is a warning; all is started."""
    Path('model.xacro').write_text(f'{HEAD}<xacro:arg name="scale" default="1"/></robot>')
    assert launch('model.xacro scal:=2') == 0
    out, err = capsys.readouterr()
    assert (out + err).count("xacro: hint: no <xacro:arg> declares 'scal'") == 1
    assert Path('first').exists() and Path('second').exists()
