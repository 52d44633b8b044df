# SPDX-License-Identifier: Apache-2.0
"""
Table of completers by the name of the argument in the parser (`dest`).

The completers of a verb follow from the names of its arguments, so that verbs need no completion
code. An argument that is not listed can have a `completer` attribute, as in argcomplete.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from importlib import import_module
from typing import Any

Completer = Callable[[str, argparse.Namespace], Iterable[str]]

OF_COMMAND = {
    ('ros2 interface package', 'package_name'): 'interfaces:packages',
    ('ros2 launch', 'package_name'): 'launching:packages_or_files',
    ('ros2 lifecycle get', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 lifecycle list', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 lifecycle set', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 run', 'package_name'): 'packages:packages_with_executables',
}
OF_ARGUMENT = {
    'action_name': 'graph:actions',
    'action_type': 'interfaces:actions',
    'argv': 'files:files',
    'bag_path': 'files:bags',
    'container_node_name': 'graph:containers',
    'dependencies': 'packages:packages',
    'destination_directory': 'files:folders',
    'exclude_topic_types': 'interfaces:messages',
    'exclude_topics': 'graph:topics',
    'executable_name': 'packages:executables',
    'input': 'files:bags',
    'launch_arguments': 'launching:arguments',
    'launch_file_name': 'launching:launch_files_of_package',
    'license': 'packages:licenses',
    'message_type': 'interfaces:messages_of_topic',
    'node_name': 'graph:nodes',
    'output': 'files:files',
    'output_options': 'files:files',
    'package_name': 'packages:packages',
    'parameter_file': 'files:files',
    'parameter_name': 'parameters:parameters',
    'parameter_names': 'parameters:parameters',
    'qos_profile_overrides_path': 'files:files',
    'service_name': 'graph:services',
    'service_type': 'interfaces:services_of_name',
    'topic_name': 'graph:topics',
    'topic_type': 'interfaces:messages',
    'topic_types': 'interfaces:messages',
    'topics': 'graph:topics',
    'topics_positional': 'graph:topics',
    'transition': 'words:transitions',
    'type': 'interfaces:interfaces',
    'values': 'prototypes:values',
}
NEVER = {  # these arguments name new objects
    ('ros2 bag record', 'node_name'),
    ('ros2 component load', 'node_name'),
    ('ros2 component standalone', 'container_node_name'),
    ('ros2 component standalone', 'node_name'),
    ('ros2 pkg create', 'node_name'),
    ('ros2 pkg create', 'package_name'),
    ('ros2 topic pub', 'node_name'),
}


def find_completer(command: str, argument: str) -> Completer | None:
    """
    Find the completer of an argument.

    Parameters
    ----------
    command
        The program name of the parser, such as `ros2 topic echo`.
    argument
        The `dest` of the argument.

    Returns
    -------
    Completer or None
        Called with the word to complete and the parsed arguments; argcomplete drops words that do
        not match.

    """
    if (command, argument) in NEVER:
        return None
    target = OF_COMMAND.get((command, argument)) or OF_ARGUMENT.get(argument)
    if target is None:
        return None
    module, _, name = target.partition(':')
    found: Any = getattr(import_module(f'ros2cli.completion.{module}'), name)
    return found  # type: ignore[no-any-return]
