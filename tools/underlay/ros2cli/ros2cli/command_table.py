# SPDX-License-Identifier: Apache-2.0
"""Static table of the commands of the underlay, so that no entry points are scanned."""

from __future__ import annotations

from ros2cli.entry import Entry

COMMAND_GROUP = 'ros2cli.command'
COMMANDS = {
    'action': Entry(
        'ros2action.command.action:ActionCommand', 'Various action related sub-commands'
    ),
    'bag': Entry('ros2bag.command.bag:BagCommand', 'Various rosbag related sub-commands'),
    'component': Entry(
        'ros2component.command.component:ComponentCommand',
        'Various component related sub-commands',
    ),
    # In a package of its own, as in a ROS installation, but in the table so that help lists it.
    'control': Entry(
        'ros2controlcli.command.control:ControlCommand', 'Various control related sub-commands'
    ),
    'daemon': Entry(
        'ros2daemon.command.daemon:DaemonCommand', 'Various daemon related sub-commands'
    ),
    'doctor': Entry(
        'ros2doctor.command.doctor:DoctorCommand', 'Check ROS setup and other potential issues'
    ),
    'extension_points': Entry(
        'ros2cli.command.extension_points:ExtensionPointsCommand',
        'List extension points',
        hidden=True,
    ),
    'extensions': Entry(
        'ros2cli.command.extensions:ExtensionsCommand', 'List extensions', hidden=True
    ),
    'interface': Entry(
        'ros2interface.command.interface:InterfaceCommand', 'Show information about ROS interfaces'
    ),
    'launch': Entry('ros2launch.command.launch:LaunchCommand', 'Run a launch file'),
    'lifecycle': Entry(
        'ros2lifecycle.command.lifecycle:LifecycleCommand',
        'Various lifecycle related sub-commands',
    ),
    'multicast': Entry(
        'ros2multicast.command.multicast:MulticastCommand',
        'Various multicast related sub-commands',
    ),
    'node': Entry('ros2node.command.node:NodeCommand', 'Various node related sub-commands'),
    'param': Entry('ros2param.command.param:ParamCommand', 'Various param related sub-commands'),
    'pkg': Entry('ros2pkg.command.pkg:PkgCommand', 'Various package related sub-commands'),
    'run': Entry('ros2run.command.run:RunCommand', 'Run a package specific executable'),
    'service': Entry(
        'ros2service.command.service:ServiceCommand', 'Various service related sub-commands'
    ),
    'topic': Entry('ros2topic.command.topic:TopicCommand', 'Various topic related sub-commands'),
    'wtf': Entry('ros2doctor.command.doctor:WtfCommand', 'Use `wtf` as alias to `doctor`'),
}
