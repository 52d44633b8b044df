# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 param`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class ParamCommand(VerbCommand):
    """Various param related sub-commands."""

    VERB_GROUP = 'ros2param.verb'
    VERBS = {
        'delete': Entry('ros2param.verb.delete:DeleteVerb', 'Delete parameter'),
        'describe': Entry(
            'ros2param.verb.describe:DescribeVerb',
            'Show descriptive information about declared parameters',
        ),
        'dump': Entry(
            'ros2param.verb.dump:DumpVerb', 'Show all of the parameters of a node in a YAML format'
        ),
        'get': Entry('ros2param.verb.get:GetVerb', 'Get parameter'),
        'list': Entry('ros2param.verb.list:ListVerb', 'Output a list of available parameters'),
        'load': Entry('ros2param.verb.load:LoadVerb', 'Load parameter file for a node'),
        'set': Entry('ros2param.verb.set:SetVerb', 'Set parameter'),
    }
