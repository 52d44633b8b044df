# SPDX-License-Identifier: Apache-2.0
"""
The commands that consist of verbs, and the tables of their verbs.

`ros2 doctor` has checks of its own, and is in its package, like the commands without verbs.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class CommandOfNames(VerbCommand):
    """A command about named entities, of which hidden ones are listed only with an option."""

    NOUN = ''

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the option shared by all verbs, then the verbs.

        Parameters
        ----------
        parser, cli_name, argv
            As for `VerbCommand.add_arguments`.

        """
        parser.add_argument(
            f'--include-hidden-{self.NOUN}',
            action='store_true',
            help=f'Consider hidden {self.NOUN} as well',
        )
        super().add_arguments(parser, cli_name, argv=argv)


class ActionCommand(VerbCommand):
    """Various action related sub-commands."""

    VERB_GROUP = 'ros2action.verb'
    VERBS = {
        'info': Entry('ros2action.verb.info:InfoVerb', 'Print information about an action'),
        'list': Entry('ros2action.verb.list:ListVerb', 'Output a list of action names'),
        'send_goal': Entry('ros2action.verb.send_goal:SendGoalVerb', 'Send an action goal'),
        'type': Entry('ros2action.verb.type:TypeVerb', "Print an action's type"),
    }


class BagCommand(VerbCommand):
    """Various rosbag related sub-commands."""

    VERB_GROUP = 'ros2bag.verb'
    VERBS = {
        'burst': Entry('ros2bag.verb.burst:BurstVerb', 'Publish a bag as fast as possible'),
        'convert': Entry(
            'ros2bag.verb.convert:ConvertVerb',
            'Given input bags, write out new bags with different settings',
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


class DaemonCommand(VerbCommand):
    """Various daemon related sub-commands."""

    VERB_GROUP = 'ros2daemon.verb'
    VERBS = {
        'start': Entry('ros2daemon.verb:StartVerb', 'Start the daemon if it is not running'),
        'status': Entry('ros2daemon.verb:StatusVerb', 'Output the status of the daemon'),
        'stop': Entry('ros2daemon.verb:StopVerb', 'Stop the daemon if it is running'),
    }


class InterfaceCommand(VerbCommand):
    """Show information about ROS interfaces."""

    VERB_GROUP = 'ros2interface.verb'
    VERBS = {
        'list': Entry('ros2interface.verb.list:ListVerb', 'List all interface types available'),
        'package': Entry(
            'ros2interface.verb.package:PackageVerb',
            'Output a list of available interface types within one package',
        ),
        'packages': Entry(
            'ros2interface.verb.packages:PackagesVerb',
            'Output a list of packages that provide interfaces',
        ),
        'proto': Entry('ros2interface.verb.proto:ProtoVerb', 'Output an interface prototype'),
        'show': Entry('ros2interface.verb.show:ShowVerb', 'Output the interface definition'),
    }


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


class MulticastCommand(VerbCommand):
    """Various multicast related sub-commands."""

    VERB_GROUP = 'ros2multicast.verb'
    VERBS = {
        'receive': Entry(
            'ros2multicast.verb.receive:ReceiveVerb', 'Receive a single UDP multicast packet'
        ),
        'send': Entry('ros2multicast.verb.send:SendVerb', 'Send a single UDP multicast packet'),
    }


class NodeCommand(VerbCommand):
    """Various node related sub-commands."""

    VERB_GROUP = 'ros2node.verb'
    VERBS = {
        'info': Entry('ros2node.verb.info:InfoVerb', 'Output information about a node'),
        'list': Entry('ros2node.verb.list:ListVerb', 'Output a list of available nodes'),
    }


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


class ServiceCommand(CommandOfNames):
    """Various service related sub-commands."""

    NOUN = 'services'
    VERB_GROUP = 'ros2service.verb'
    VERBS = {
        'call': Entry('ros2service.verb.call:CallVerb', 'Call a service'),
        'echo': Entry('ros2service.verb.echo:EchoVerb', 'Echo a service'),
        'find': Entry(
            'ros2service.verb.find:FindVerb', 'Output a list of available services of a given type'
        ),
        'info': Entry('ros2service.verb.info:InfoVerb', 'Print information about a service'),
        'list': Entry('ros2service.verb.list:ListVerb', 'Output a list of available services'),
        'type': Entry('ros2service.verb.type:TypeVerb', "Output a service's type"),
    }


class TopicCommand(CommandOfNames):
    """Various topic related sub-commands."""

    NOUN = 'topics'
    VERB_GROUP = 'ros2topic.verb'
    VERBS = {
        'bw': Entry('ros2topic.verb.bw:BwVerb', 'Display bandwidth used by topic'),
        'delay': Entry(
            'ros2topic.verb.delay:DelayVerb', 'Display delay of topic from timestamp in header'
        ),
        'echo': Entry('ros2topic.verb.echo:EchoVerb', 'Output messages from a topic'),
        'find': Entry(
            'ros2topic.verb.find:FindVerb', 'Output a list of available topics of a given type'
        ),
        'hz': Entry('ros2topic.verb.hz:HzVerb', 'Print the average publishing rate to screen'),
        'info': Entry('ros2topic.verb.info:InfoVerb', 'Print information about a topic'),
        'list': Entry('ros2topic.verb.list:ListVerb', 'Output a list of available topics'),
        'pub': Entry('ros2topic.verb.pub:PubVerb', 'Publish a message to a topic'),
        'type': Entry('ros2topic.verb.type:TypeVerb', "Print a topic's type"),
    }
