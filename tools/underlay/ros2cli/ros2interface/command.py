# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 interface`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class InterfaceCommand(VerbCommand):
    """Show information about ROS interfaces."""

    VERB_GROUP = 'ros2interface.verb'
    VERBS = {
        'list': Entry('ros2interface.verb.list:ListVerb', 'List all interface types available'),
        'package': Entry(
            'ros2interface.verb.package:PackageVerb',
            'Output a list of available interface types within one package',
        ),
        'packages': Entry(
            'ros2interface.verb.packages:PackagesVerb',
            'Output a list of packages that provide interfaces',
        ),
        'proto': Entry('ros2interface.verb.proto:ProtoVerb', 'Output an interface prototype'),
        'show': Entry('ros2interface.verb.show:ShowVerb', 'Output the interface definition'),
    }
