# SPDX-License-Identifier: Apache-2.0
"""The commands that this package installs; a static table, so that nothing is scanned."""

from __future__ import annotations

from ros2cli.entry import Entry

COMMANDS = {
    'doctor': Entry(
        'ros2doctor.command.doctor:DoctorCommand', 'Check ROS setup and other potential issues'
    ),
    'launch': Entry('ros2launch.command.launch:LaunchCommand', 'Run a launch file'),
    'node': Entry('ros2node.command.node:NodeCommand', 'Various node related sub-commands'),
    'pkg': Entry('ros2pkg.command.pkg:PkgCommand', 'Various package related sub-commands'),
    'run': Entry('ros2run.command.run:RunCommand', 'Run a package specific executable'),
    'topic': Entry('ros2topic.command.topic:TopicCommand', 'Various topic related sub-commands'),
    'wtf': Entry('ros2doctor.command.doctor:WtfCommand', 'Use `wtf` as alias to `doctor`'),
}
