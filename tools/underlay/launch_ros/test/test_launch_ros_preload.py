# SPDX-License-Identifier: Apache-2.0
"""What is imported for the nodes of a launch, and nodes that are forked."""

from __future__ import annotations

from collections.abc import Callable
import json
import os
from pathlib import Path
import sys
from typing import Any

from launch_ros._preload import imports_of
from launch_ros.actions import Node
import pytest

# No link: a path with spaces cannot stand in the first line of a script.
INTERPRETER = Path(sys.executable).parent.resolve() / 'python3'
# As setuptools writes it.
CONSOLE_SCRIPT = f"""#!{INTERPRETER}
# EASY-INSTALL-ENTRY-SCRIPT: 'some-nodes==0.1.0','console_scripts','talker'
import re
import sys
from importlib.metadata import distribution


def load_entry_point(spec, group, name):
    points = distribution(spec.partition('==')[0]).entry_points
    return next(p for p in points if p.group == group and p.name == name).load()


if __name__ == '__main__':
    sys.exit(load_entry_point('some-nodes==0.1.0', 'console_scripts', 'talker')())
"""
FILES = {
    'some_nodes/__init__.py': '',
    'some_nodes/talker.py': """
import json, os, sys, threading
import rclpy
from some_nodes import helper


def main():
    before = {'forked': os.path.basename(sys._getframe().f_back.f_back.f_code.co_filename
                                         if sys._getframe().f_back.f_back else ''),
              'threads': len(os.listdir('/proc/self/task'))}
    rclpy.init()
    node = rclpy.create_node('talker')
    publisher = node.create_publisher(helper.Temperature, 'temperature', 1)
    publisher.publish(helper.Temperature(temperature=1.0))
    print(json.dumps({**before, 'name': node.get_fully_qualified_name(),
                      'domain': rclpy.get_default_context().get_domain_id()}), flush=True)
    node.destroy_node()
    rclpy.shutdown()
    return 3
""",
    'some_nodes/helper.py': 'from sensor_msgs.msg import Temperature\nimport unknown_to_all\n',
    'unknown_to_all.py': '',
    'some_nodes-0.1.0.dist-info/METADATA': 'Name: some-nodes\nVersion: 0.1.0\n',
    'some_nodes-0.1.0.dist-info/entry_points.txt': '[console_scripts]\n'
    'talker = some_nodes.talker:main\n',
}


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Install a package with a console script; return the path of the script."""
    for name, text in FILES.items():
        path = tmp_path / 'lib' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.syspath_prepend(str(tmp_path / 'lib'))
    monkeypatch.setenv(
        'PYTHONPATH', os.pathsep.join((str(tmp_path / 'lib'), os.environ.get('PYTHONPATH', '')))
    )
    path = tmp_path / 'talker'
    path.write_text(CONSOLE_SCRIPT)
    path.chmod(0o755)
    return str(path)


def test_imports(script: str) -> None:
    """Imports are followed through the modules of the workspace, and none of them is run."""
    found = set(imports_of([script]))
    assert {('rclpy', ()), ('sensor_msgs.msg', ('Temperature',))} <= found
    assert not {'some_nodes', 'unknown_to_all'} & set(sys.modules)


@pytest.mark.parametrize('text', ['import (', '', '\0', "load('absent', 'console_scripts', 'x')"])
def test_imports_of_what_cannot_be_read(tmp_path: Path, text: str) -> None:
    """Nothing is imported for a script that is in order or not, but imports nothing."""
    path = tmp_path / 'script'
    path.write_text(text)
    assert list(imports_of([str(path), str(tmp_path / 'missing')])) == []


def test_forked_nodes(
    run: Callable[..., Any], script: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nodes that are forked work, with names and environments of their own, and end in order."""
    pytest.importorskip('rclpy')
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'OFF')
    nodes = [
        Node(
            executable=script,
            name=f'talker_{number}',
            namespace='robot',
            additional_env={'ROS_DOMAIN_ID': str(number)},
            output='screen',
            output_format='{line}',
        )
        for number in range(3)
    ]
    status, out = run(*nodes)
    assert status == 0
    answers = [json.loads(line) for line in out.splitlines() if line.startswith('{')]
    assert sorted(answer['name'] for answer in answers) == [
        f'/robot/talker_{number}' for number in range(3)
    ]
    assert sorted(answer['domain'] for answer in answers) == [0, 1, 2]
    assert {answer['forked'] for answer in answers} == {'template.py'}
    assert [node.return_code for node in nodes] == [3, 3, 3], out
