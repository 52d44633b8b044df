# SPDX-License-Identifier: Apache-2.0
"""For tests: packages as students write them, with one mistake or none, and their check."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from humanoid_common.testing.processes import module_command, running_program
from humanoid_course.grading import Outcome

_LONGEST_S = 250.0
MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>TODO: Package description</description>
  <maintainer email="me@example.com">me</maintainer>
  <license>Apache-2.0</license>
{depends}
  <export><build_type>ament_python</build_type></export>
</package>
"""
SETUP = """from glob import glob

from setuptools import setup

setup(
    name='{name}',
    version='0.0.0',
    packages={packages},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/{name}']),
        ('share/{name}', ['package.xml']),
        ('share/{name}/launch', glob('launch/*')),
        ('share/{name}/urdf', glob('urdf/*')),
    ],
    entry_points={{'console_scripts': [{scripts}]}},
)
"""
SETUP_CFG = '[develop]\nscript_dir=$base/lib/{name}\n[install]\ninstall_scripts=$base/lib/{name}\n'
MAIN = """

def main():
    rclpy.init()
    try:
        rclpy.spin({node}())
    except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
"""
TEMP_PUBLISHER = """import random

import rclpy
import rclpy.executors
from rclpy.node import Node
from std_msgs.msg import Float32


class Publisher(Node):

    def __init__(self):
        super().__init__('temp_publisher')
        self.publisher = self.create_publisher(Float32, '/temperature', 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.publisher.publish(Float32(data=random.uniform(20.0, 30.0)))
""" + MAIN.format(node='Publisher')
TEMP_ANALYZER = """import rclpy
import rclpy.executors
from rclpy.node import Node
from std_msgs.msg import Float32


class Analyzer(Node):

    def __init__(self):
        super().__init__('temp_analyzer')
        self.create_subscription(Float32, '/temperature', self.judge, 10)

    def judge(self, message):
        self.get_logger().info(f'It is {message.data:.1f}')
        if message.data > 25.0:
            self.get_logger().warning(f'High: {message.data:.1f}')
""" + MAIN.format(node='Analyzer')
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
{nodes}
    ])
"""
TWO_NODES = ''.join(
    f"        Node(package='temperature_monitor', executable='{name}'),\n"
    for name in ('temp_publisher', 'temp_analyzer')
)
CONTROLLER = """import rclpy
import rclpy.executors
from rclpy.node import Node
from sensor_msgs.msg import JointState


class Controller(Node):

    def __init__(self):
        super().__init__('humanoid_joint_controller')
        self.publisher = self.create_publisher(JointState, 'joint_commands', 10)
        self.create_timer(0.02, self.tick)

    def tick(self):
        self.publisher.publish(JointState(name=['left_elbow'], position=[0.5]))
""" + MAIN.format(node='Controller')
THREE_CONTROLLERS = ''.join(
    f"        Node(package='humanoid_control', executable='joint_controller', "
    f"name='joint_controller', namespace='robot{index}'),\n"
    for index in (1, 2, 3)
)
URDF = '<?xml version="1.0"?>\n<robot name="arm"><link name="base"/></robot>\n'
HOLDER = """import rclpy
import rclpy.executors
from rclpy.node import Node


class Holder(Node):

    def __init__(self):
        super().__init__('holder')
        self.declare_parameter('robot_description', '')
""" + MAIN.format(node='Holder')
MODEL_LAUNCH = """import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description():
    share = get_package_share_directory('robot_description')
    with open(os.path.join(share, 'urdf', 'arm.urdf')) as file:
        text = ParameterValue(file.read(), value_type=str)
    return LaunchDescription([
        Node(package='robot_control', executable='holder',
             parameters=[{'robot_description': text}]),
    ])
"""


@dataclass(frozen=True)
class Mistake:
    """A change of one file of a right package: a text that is replaced, or a file that goes."""

    file: str
    old: str
    new: str | None


def write_workspace(
    folder: Path, packages: Mapping[str, Mapping[str, str]], mistake: Mistake | None = None
) -> Path:
    """
    Write packages into src/ of a workspace, with a mistake in one of their files.

    Parameters
    ----------
    folder
        The folder of the workspace.
    packages
        The texts of the files of each package.
    mistake
        The mistake, if any.

    Returns
    -------
    Path
        The folder of the workspace.

    Raises
    ------
    ValueError
        The text that the mistake replaces is not there.

    """
    for name, files in packages.items():
        for relative, text in files.items():
            path = folder / 'src' / name / relative
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    if mistake is not None:
        path = folder / 'src' / mistake.file
        text = path.read_text()
        if mistake.old not in text:
            raise ValueError(f'{mistake.old!r} is not in {mistake.file}')
        if mistake.new is None:
            path.unlink()
        else:
            path.write_text(text.replace(mistake.old, mistake.new))
    return folder


def _package(name: str, depends: str, scripts: str, files: Mapping[str, str]) -> dict[str, str]:
    """Return the files of a package; those of its modules are in a folder of its name."""
    words = [f"'{each} = {name}.{each}:main'" for each in scripts.split()]
    lines = ''.join(f'  <depend>{each}</depend>\n' for each in depends.split())
    modules = [f"'{name}'"] if scripts else []
    return {
        'package.xml': MANIFEST.format(name=name, depends=lines),
        'setup.py': SETUP.format(
            name=name, packages=f'[{"".join(modules)}]', scripts=', '.join(words)
        ),
        'setup.cfg': SETUP_CFG.format(name=name),
        f'resource/{name}': '',
        **({f'{name}/__init__.py': ''} if scripts else {}),
        **files,
    }


TEMPERATURE_MONITOR = {
    'temperature_monitor': _package(
        'temperature_monitor',
        'rclpy std_msgs',
        'temp_publisher temp_analyzer',
        {
            'temperature_monitor/temp_publisher.py': TEMP_PUBLISHER,
            'temperature_monitor/temp_analyzer.py': TEMP_ANALYZER,
            'launch/both.launch.py': LAUNCH.format(nodes=TWO_NODES),
        },
    )
}
THREE_ROBOTS = {
    'humanoid_control': _package(
        'humanoid_control',
        'rclpy sensor_msgs',
        'joint_controller',
        {
            'humanoid_control/joint_controller.py': CONTROLLER,
            'launch/a_broken.launch.py': 'raise SystemError("not the one of the exercise")\n',
            'launch/three.launch.py': LAUNCH.format(nodes=THREE_CONTROLLERS),
        },
    )
}
MODEL_AND_CONTROL = {
    'robot_description': _package('robot_description', '', '', {'urdf/arm.urdf': URDF}),
    'robot_control': _package(
        'robot_control',
        'rclpy robot_description',
        'holder',
        {'robot_control/holder.py': HOLDER, 'launch/model.launch.py': MODEL_LAUNCH},
    ),
}


def run_check(*arguments: str) -> tuple[int, str]:
    """
    Run the command, which may not end with a traceback.

    Parameters
    ----------
    *arguments
        Its arguments.

    Returns
    -------
    int, str
        Its exit status, and its output.

    Raises
    ------
    AssertionError
        There is a traceback in its errors.

    """
    with running_program(module_command('humanoid_course.check', *arguments)) as program:
        report = program.wait_for_exit(_LONGEST_S)
    if 'Traceback' in report.stderr:
        raise AssertionError(report.output)
    return report.status, report.output


def criteria_in(output: str, outcome: Outcome) -> list[str]:
    """
    Read the names of the criteria with an outcome from the output of the command.

    Parameters
    ----------
    output
        The output.
    outcome
        The outcome.

    """
    return [
        line.removeprefix(outcome.value).strip().partition(':')[0]
        for line in output.splitlines()
        if line.startswith(f'{outcome.value}  ')
    ]
