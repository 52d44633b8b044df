# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 action`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class ActionCommand(VerbCommand):
    """Various action related sub-commands."""

    VERB_GROUP = 'ros2action.verb'
    VERBS = {
        'info': Entry('ros2action.verb.info:InfoVerb', 'Print information about an action'),
        'list': Entry('ros2action.verb.list:ListVerb', 'Output a list of action names'),
        'send_goal': Entry('ros2action.verb.send_goal:SendGoalVerb', 'Send an action goal'),
        'type': Entry('ros2action.verb.type:TypeVerb', "Print an action's type"),
    }
