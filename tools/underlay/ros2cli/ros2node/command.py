# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 node`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class NodeCommand(VerbCommand):
    """Various node related sub-commands."""

    VERB_GROUP = 'ros2node.verb'
    VERBS = {
        'info': Entry('ros2node.verb.info:InfoVerb', 'Output information about a node'),
        'list': Entry('ros2node.verb.list:ListVerb', 'Output a list of available nodes'),
    }
