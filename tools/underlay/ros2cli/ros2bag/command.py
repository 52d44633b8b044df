# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 bag`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class BagCommand(VerbCommand):
    """Various rosbag related sub-commands."""

    VERB_GROUP = 'ros2bag.verb'
    VERBS = {
        'burst': Entry('ros2bag.verb.burst:BurstVerb', 'Publish a bag as fast as possible'),
        'convert': Entry(
            'ros2bag.verb.convert:ConvertVerb', 'Show how to convert a bag to another format'
        ),
        'info': Entry('ros2bag.verb.info:InfoVerb', 'Print information about a bag'),
        'list': Entry('ros2bag.verb.list:ListVerb', 'Print the supported formats'),
        'play': Entry('ros2bag.verb.play:PlayVerb', 'Play back ROS data from a bag'),
        'record': Entry('ros2bag.verb.record:RecordVerb', 'Record ROS data to a bag'),
        'recover': Entry(
            'ros2bag.verb.recover:RecoverVerb', 'Make a broken or unfinished bag readable'
        ),
        'reindex': Entry(
            'ros2bag.verb.reindex:ReindexVerb', 'Recreate the metadata of a bag from its files'
        ),
    }
