# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 multicast`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class MulticastCommand(VerbCommand):
    """Various multicast related sub-commands."""

    VERB_GROUP = 'ros2multicast.verb'
    VERBS = {
        'receive': Entry(
            'ros2multicast.verb.receive:ReceiveVerb', 'Receive a single UDP multicast packet'
        ),
        'send': Entry('ros2multicast.verb.send:SendVerb', 'Send a single UDP multicast packet'),
    }
