# SPDX-License-Identifier: Apache-2.0
"""The executables as processes: what they publish, log and answer, and how they end."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
import re
import signal
from unittest.mock import call, Mock

from demo_nodes_py.parameters.set_parameters_callback import SetParametersCallback
from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer
from demo_nodes_py.topics.qos_program import parse_options
from example_interfaces.srv import AddTwoInts
from publisher_probe import Probe, Program, Programs, TIMEOUT_S
import pytest
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data, ReliabilityPolicy
from rclpy.task import Future
from rclpy.topic_endpoint_info import TopicEndpointInfo
from service_msgs.msg import ServiceEventInfo
from std_msgs.msg import String
from tf2_ros import executing

EXECUTABLES = (
    'talker listener talker_qos listener_qos listener_serialized add_two_ints_server '
    'add_two_ints_client add_two_ints_client_async introspection async_param_client '
    'set_parameters_callback matched_event_detect use_logger_service'.split()
)
MATCHED = """
[multi_sub_node]: Create a new subscription.
[matched_event_detect_node]: First subscription is connected.
[multi_sub_node]: Create a new subscription.
[matched_event_detect_node]: The changed number of connected subscription is 1 and current \
number of connected subscription is 2.
[multi_sub_node]: Destroy a subscription.
[matched_event_detect_node]: The changed number of connected subscription is -1 and current \
number of connected subscription is 1.
[multi_sub_node]: Destroy a subscription.
[matched_event_detect_node]: Last subscription is disconnected.
[multi_pub_node]: Create a new publisher.
[matched_event_detect_node]: First publisher is connected.
[multi_pub_node]: Create a new publisher.
[matched_event_detect_node]: The changed number of connected publisher is 1 and current \
number of connected publisher is 2.
[multi_pub_node]: Destroy a publisher.
[matched_event_detect_node]: The changed number of connected publisher is -1 and current \
number of connected publisher is 1.
[multi_pub_node]: Destroy a publisher.
[matched_event_detect_node]: Last publisher is disconnected.
"""
LEVELS = """
[TestNode]: Output with default logger level:
[LoggerServiceNode]: Output 1 with INFO logger level.
[LoggerServiceNode]: Output 1 with WARN logger level.
[LoggerServiceNode]: Output 1 with ERROR logger level.
[TestNode]: Current logger level: 0
[TestNode]: Output with debug logger level:
[LoggerServiceNode]: Output 2 with DEBUG logger level.
[LoggerServiceNode]: Output 2 with INFO logger level.
[LoggerServiceNode]: Output 2 with WARN logger level.
[LoggerServiceNode]: Output 2 with ERROR logger level.
[TestNode]: Current logger level: 10
[TestNode]: Output with warn logger level:
[LoggerServiceNode]: Output 3 with WARN logger level.
[LoggerServiceNode]: Output 3 with ERROR logger level.
[TestNode]: Current logger level: 30
[TestNode]: Output with error logger level:
[LoggerServiceNode]: Output 4 with ERROR logger level.
[TestNode]: Current logger level: 40
"""


def says(probe: Probe, program: Program, text: str) -> None:
    """Wait until a program has written a text."""
    probe.until(lambda: text in program.output, f'it did not say {text!r}: {program.output}')


def logged(program: Program) -> list[str]:
    """Wait until a program has ended in order; return its log without levels and times."""
    assert program.process.wait(TIMEOUT_S) == 0
    return re.sub(r'^\[\w+\] \[[\d.]+\] ', '', program.output, flags=re.MULTILINE).splitlines()


def ends(program: Program, number: signal.Signals) -> None:
    """Stop a program, which ends in order; nothing has gone wrong in it."""
    assert program.end(number) == 0
    # rmw_fastrtps itself warns in other words if a client is not discovered in time.
    assert not re.search(r'Traceback|\[(WARN|ERROR|FATAL)\]', program.output), program.output


def test_executables() -> None:
    """All executables of the genuine package are there."""
    setup = (Path(__file__).parents[1] / 'setup.py').read_text()
    scripts = re.findall(r"'(\w+) = ([\w.]+):(\w+)'", setup)
    assert sorted(name for name, _, _ in scripts) == sorted(EXECUTABLES)
    assert all(callable(getattr(import_module(module), name)) for _, module, name in scripts)


def test_talker_and_listeners(probe: Probe, programs: Programs) -> None:
    """Two listeners hear the talker; all end on a signal."""
    listener = programs.start('demo_nodes_py.topics.listener')
    serialized = programs.start('demo_nodes_py.topics.listener_serialized')
    talker = programs.start('demo_nodes_py.topics.talker')
    says(probe, talker, '[talker]: Publishing: "Hello World: 0"')
    says(probe, listener, '[listener]: I heard: [Hello World: ')
    heard = r"""I heard: "b'\x00\x01\x00\x00\x0f\x00\x00\x00Hello World: """
    says(probe, serialized, f'[serialized_subscriber]: {heard}')
    ends(listener, signal.SIGINT)
    ends(serialized, signal.SIGTERM)
    ends(talker, signal.SIGINT)


def test_quality_of_service(probe: Probe, programs: Programs) -> None:
    """Both programs end after the number of messages, and are as reliable as they are told."""
    talker = programs.start('demo_nodes_py.topics.talker_qos', '--reliable', '-n', '1000')
    found: list[TopicEndpointInfo] = []

    def is_found() -> bool:
        found.extend(probe.node.get_publishers_info_by_topic('/chatter'))
        return bool(found)

    probe.until(is_found, 'no talker')
    assert found[0].qos_profile.reliability == ReliabilityPolicy.RELIABLE
    ends(talker, signal.SIGINT)
    published = '[talker_qos]: Publishing: "Hello World: 0"'
    talker = programs.start('demo_nodes_py.topics.talker_qos', '--reliable', '-n', '1')
    assert logged(talker) == ['[talker_qos]: Reliable talker', published]
    listener = programs.start('demo_nodes_py.topics.listener_qos', '-n', '1')
    sender = probe.sender(String, '/chatter', qos_profile_sensor_data)
    probe.send_until(
        lambda: sender.publish(String(data='hello')),
        lambda: listener.process.poll() is not None,
        'it has not ended',
    )
    heard = '[listener_qos]: I heard: [hello]'
    assert logged(listener) == ['[listener_qos]: Best effort listener', heard]


@pytest.mark.parametrize('count', ['0', '-3', 'many'])
def test_wrong_number_of_messages(count: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It is refused in a sentence."""
    with pytest.raises(SystemExit):
        parse_options(['-n', count], 'talker_qos', 'published')
    assert f"'{count}' is not a number of messages" in capsys.readouterr().err


def test_service_and_clients(probe: Probe, programs: Programs) -> None:
    """A client waits for the service, and ends with the sum; or when it is told to."""
    client = programs.start('demo_nodes_py.services.add_two_ints_client')
    other = programs.start('demo_nodes_py.services.add_two_ints_client_async')
    waiting = '[add_two_ints_client]: service not available, waiting again...'
    says(probe, client, waiting)
    says(probe, other, waiting)
    ends(other, signal.SIGINT)
    server = programs.start('demo_nodes_py.services.add_two_ints_server')
    assert logged(client)[-1] == '[add_two_ints_client]: Result of add_two_ints: 5'
    says(probe, server, '[add_two_ints_server]: Incoming request\na: 2 b: 3\n')
    ends(server, signal.SIGTERM)


def test_lost_response(monkeypatch: pytest.MonkeyPatch) -> None:
    """A request is repeated until there is a response."""

    async def no_time(*_: object) -> None:
        pass

    answered: Future[str] = Future()
    answered.set_result('5')
    client = Mock()
    client.call_async.side_effect = [Future(), answered]
    monkeypatch.setattr(executing, 'sleep', no_time)
    with pytest.raises(StopIteration) as end:
        executing.response_of(Mock(), lambda: client.call_async('add')).send(None)
    assert end.value.value == '5'
    assert client.call_async.call_args_list == [call('add'), call('add')]


def test_sum_that_is_too_large(probe: Probe) -> None:
    """It wraps around, and ends no server."""
    server = AddTwoIntsServer(context=probe.node.context)
    request = AddTwoInts.Request(a=2**63 - 1, b=1)
    response = server.add_two_ints_callback(request, AddTwoInts.Response())
    assert response.sum == -(2**63)
    server.destroy_node()


def test_introspection(probe: Probe, programs: Programs) -> None:
    """Each side publishes about its calls what its parameter says."""
    events = probe.listen(AddTwoInts.Event, '/add_two_ints/_service_event')
    wanted = '-p', 'service_configure_introspection:=contents'
    nodes = programs.start('demo_nodes_py.services.introspection', '--ros-args', *wanted)
    of_service = {ServiceEventInfo.REQUEST_RECEIVED, ServiceEventInfo.RESPONSE_SENT}
    of_client = {ServiceEventInfo.REQUEST_SENT, ServiceEventInfo.RESPONSE_RECEIVED}

    def kinds() -> set[int]:
        return {event.info.event_type for event in events}

    probe.until(lambda: kinds() == of_service, 'the service is silent')
    (result,) = probe.set_parameters('introspection_client', client_configure_introspection='all')
    assert result.reason == "must be one of 'disabled', 'metadata', or 'contents'"
    probe.set_parameters('introspection_client', client_configure_introspection='metadata')
    probe.until(lambda: kinds() == of_service | of_client, 'the client is silent')
    sums = {
        (event.info.event_type in of_client, tuple(each.sum for each in event.response))
        for event in events
        if event.info.event_type in (ServiceEventInfo.RESPONSE_SENT, *of_client)
    }
    assert sums == {(False, (5,)), (True, ())}
    says(probe, nodes, '[introspection_client]: Result of add_two_ints: 5')
    ends(nodes, signal.SIGINT)


def test_one_parameter_sets_another(probe: Probe) -> None:
    """Setting `param1` sets both, whatever is asked for, and `param2` only itself."""
    node = SetParametersCallback(context=probe.node.context)

    def values() -> list[float]:
        return [parameter.value for parameter in node.get_parameters(['param1', 'param2'])]

    assert values() == [0.0, 0.0]
    asked_for = [Parameter('param2', value=7.0), Parameter('param1', value=28.0)]
    assert node.set_parameters_atomically(asked_for).successful
    assert values() == [28.0, 4.0]
    assert node.set_parameters([Parameter('param2', value=1.5)])[0].successful
    assert values() == [28.0, 1.5]
    node.destroy_node()


@pytest.mark.parametrize(
    ('module', 'wanted'),
    [('events.matched_event_detect', MATCHED), ('logging.use_logger_service', LEVELS)],
)
def test_demonstration(programs: Programs, module: str, wanted: str) -> None:
    """What a program shows, line by line, until it ends."""
    assert logged(programs.start(f'demo_nodes_py.{module}')) == wanted.strip().splitlines()
