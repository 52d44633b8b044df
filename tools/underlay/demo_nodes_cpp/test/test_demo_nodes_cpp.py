# SPDX-License-Identifier: Apache-2.0
"""What differs from demo_nodes_py, and the files that name the nodes."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
import re
from typing import Any

from demo_nodes_cpp.even_parameters_node import EvenParameterNode
from demo_nodes_cpp.talker import Talker
from launch import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node
from publisher_probe import Probe, Programs, TIMEOUT_S
import pytest
from rclpy.parameter import Parameter
from std_msgs.msg import String

PACKAGE = Path(__file__).parents[1]
SCRIPTS = dict(re.findall(r"'(\w+) = ([\w.:]+)'", (PACKAGE / 'setup.py').read_text()))
COMPONENTS = (PACKAGE / 'resource/rclcpp_components/demo_nodes_cpp').read_text().splitlines()
LAUNCH_FILES = sorted(PACKAGE.glob('launch/*/*'))
CHANGES = """
Setting parameters:
    int_parameter:
        successful: True
    bool_parameter:
        successful: True
    string_parameter:
        successful: True
Listing Parameters:
    - bool_parameter
    - int_parameter
    - string_parameter
Getting parameters:
    - int_parameter: 10
    - bool_parameter: False
    - string_parameter: Fee Fi Fo Fum
Loading parameters:
    other_int_parameter:
        successful: True
        value: 0
    int_parameter:
        successful: True
        value: 12
    string_parameter:
        successful: True
        value: I smell the blood of an Englishman
    other_string_parameter:
        successful: True
        value: One fish, two fish, Red fish, blue fish
    bool_parameter:
        successful: True
        value: False
Deleting parameters:
    other_int_parameter:
        successful: True
        reason:
    other_string_parameter:
        successful: True
        reason:
    string_parameter:
        successful: True
        reason:
"""


def found(place: str) -> object:
    """Import what a place such as `module:name` names."""
    module, _, name = place.partition(':')
    return getattr(import_module(module), name)


def test_executables_and_components() -> None:
    """Each names a function or class that exists."""
    assert len(SCRIPTS) == 12 and all(callable(found(place)) for place in SCRIPTS.values())
    for line in COMPONENTS:
        name, _, place = line.partition(';')
        assert name.startswith('demo_nodes_cpp::') and callable(found(place))


@pytest.mark.parametrize('path', LAUNCH_FILES, ids=lambda path: path.name)
def test_launch_file(path: Path) -> None:
    """It starts two executables that exist."""
    context = LaunchContext()

    def text(words: Any) -> str:
        return perform_substitutions(context, normalize_to_list_of_substitutions(words))

    description = AnyLaunchDescriptionSource(str(path)).get_launch_description(context)
    nodes = [entity for entity in description.entities if isinstance(entity, Node)]
    assert [text(node.node_package) for node in nodes] == ['demo_nodes_cpp'] * 2
    assert {text(node.node_executable) for node in nodes} <= set(SCRIPTS)


def test_talker(probe: Probe) -> None:
    """It counts from 1 and keeps 7 messages."""
    heard = probe.listen(String, '/chatter')
    talker = Talker(context=probe.node.context)
    (publisher,) = [each for each in talker.publishers if each.topic_name == '/chatter']
    assert publisher.qos_profile.depth == 7
    probe.until(publisher.get_subscription_count, 'nobody listens')
    talker.timer_callback()
    probe.until(lambda: heard, 'nothing was heard')
    assert heard[0].data == 'Hello World: 1'
    talker.destroy_node()


def test_blackboard_and_its_client(probe: Probe, programs: Programs) -> None:
    """The client changes the blackboard's parameters in all ways, and logs the results."""
    start = '-p', 'colour:=red'
    blackboard = programs.start('demo_nodes_cpp.parameter_blackboard', '--ros-args', *start)
    ready = "Parameter blackboard node named '/parameter_blackboard' ready, and serving '"
    probe.until(lambda: ready in blackboard.output, 'it is not ready')
    client = programs.start('demo_nodes_py.parameters.async_param_client')
    assert client.process.wait(TIMEOUT_S) == 0
    lines = re.sub(r'\[INFO\] \[[\d.]+\] \[async_param_client\]: ', '', client.output)
    wanted = CHANGES.strip('\n')
    assert [line.rstrip() for line in lines.splitlines()] == wanted.splitlines()
    assert blackboard.end() == 0


def test_even_parameters(probe: Probe, capfd: pytest.CaptureFixture[str]) -> None:
    """Even integers are accepted, and nothing else."""
    node = EvenParameterNode(context=probe.node.context)
    values = (2, 3, 2.0)
    results = [node.set_parameters([Parameter('myint', value=value)])[0] for value in values]
    assert [result.successful for result in results] == [True, False, False]
    assert node.get_parameter('myint').value == 2
    log = capfd.readouterr().err
    assert "parameter 'myint' has changed and is now: 2" in log
    assert "Requested value '3' for parameter 'myint' is not an even number: rejecting" in log
    node.destroy_node()
