# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 lifecycle`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class LifecycleCommand(VerbCommand):
    """Various lifecycle related sub-commands."""

    VERB_GROUP = 'ros2lifecycle.verb'
    VERBS = {
        'get': Entry(
            'ros2lifecycle.verb.get:GetVerb', 'Get lifecycle state for one or more nodes'
        ),
        'list': Entry(
            'ros2lifecycle.verb.list:ListVerb', 'Output a list of available transitions'
        ),
        'nodes': Entry(
            'ros2lifecycle.verb.nodes:NodesVerb',
            'Output a list of nodes with lifecycle',
        ),
        'set': Entry('ros2lifecycle.verb.set:SetVerb', 'Trigger lifecycle state transition'),
    }
