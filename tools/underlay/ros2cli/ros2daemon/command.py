# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 daemon`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class DaemonCommand(VerbCommand):
    """Various daemon related sub-commands."""

    VERB_GROUP = 'ros2daemon.verb'
    VERBS = {
        'start': Entry('ros2daemon.verb:StartVerb', 'Start the daemon if it is not running'),
        'status': Entry('ros2daemon.verb:StatusVerb', 'Output the status of the daemon'),
        'stop': Entry('ros2daemon.verb:StopVerb', 'Stop the daemon if it is running'),
    }
