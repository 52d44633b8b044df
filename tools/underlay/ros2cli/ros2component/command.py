# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 component`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class ComponentCommand(VerbCommand):
    """Various component related sub-commands."""

    VERB_GROUP = 'ros2component.verb'
    VERBS = {
        'list': Entry(
            'ros2component.verb.list:ListVerb',
            'Output a list of running containers and components',
        ),
        'load': Entry(
            'ros2component.verb.load:LoadVerb', 'Load a component into a container node'
        ),
        'standalone': Entry(
            'ros2component.verb.standalone:StandaloneVerb',
            'Run a component into its own standalone container node',
        ),
        'types': Entry(
            'ros2component.verb.component_types:TypesVerb',
            'Output a list of components registered in the ament index',
        ),
        'unload': Entry(
            'ros2component.verb.unload:UnloadVerb', 'Unload a component from a container node'
        ),
    }
