# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 pkg`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class PkgCommand(VerbCommand):
    """Various package related sub-commands."""

    VERB_GROUP = 'ros2pkg.verb'
    VERBS = {
        'create': Entry('ros2pkg.verb.create:CreateVerb', 'Create a new ROS 2 package'),
        'executables': Entry(
            'ros2pkg.verb.executables:ExecutablesVerb',
            'Output a list of package specific executables',
        ),
        'list': Entry('ros2pkg.verb.list:ListVerb', 'Output a list of available packages'),
        'prefix': Entry('ros2pkg.verb.prefix:PrefixVerb', 'Output the prefix path of a package'),
        'xml': Entry(
            'ros2pkg.verb.xml_manifest:XmlVerb',
            'Output the XML of the package manifest or a specific tag',
        ),
    }
