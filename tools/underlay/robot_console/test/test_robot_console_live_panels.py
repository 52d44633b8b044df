# SPDX-License-Identifier: Apache-2.0
"""The panels of what a system says, over DDS and over the connections of their pages."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from http.client import HTTPConnection
import json
import math
import time
from typing import Any
from unittest import mock

from audio_common_msgs.msg import AudioData
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from live_world import Browser, live_world, LiveWorld, PANELS
import pytest
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
import rclpy
from rclpy.context import Context as RosContext
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_console import simulator_link
from robot_console.panels.command import Command
from robot_console.panels.objects import Objects
from robot_console.robot_link import link_of
from robot_console.service_calls import ServiceCalls
from robot_console.simulator_link import SimulatorLink
from simulation_interfaces.msg import Resource, Result, SimulationState, WorldResource
from simulation_interfaces.srv import (
    GetAvailableWorlds,
    GetCurrentWorld,
    GetSimulationState,
    LoadWorld,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
)
from std_msgs.msg import Bool, Header, String
from std_srvs.srv import SetBool, Trigger
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


@pytest.fixture
def world() -> Iterator[LiveWorld]:
    """Return a page and a robot."""
    with live_world() as world:
        yield world


def status(name: str, level: int, message: str = '') -> DiagnosticArray:
    """Return what a part says."""
    values = [KeyValue(key='volts', value='24.1')]
    each = DiagnosticStatus(name=name, level=bytes([level]), message=message, values=values)
    return DiagnosticArray(status=[each])


def test_log(world: LiveWorld) -> None:
    """A page is told what was said before, and what is said from then on."""
    world.robot.get_logger().warning('before')
    page = world.visit('log', Namespace='robot1')
    page.wait_for('lines', lambda lines: any('before' in line[3] for line in lines))
    world.node.get_logger().info('of another robot')
    world.robot.get_logger().error('<b>broken</b> \n "now"')
    told = page.wait_for('lines', lambda lines: any('broken' in line[3] for line in lines))
    line = told['lines'][-1]
    assert line[1:4] == [40, 'robot1.robot', '<b>broken</b> \n "now"'] and 'test_log' in line[4]
    assert told['counts'] == {'30': 1, '40': 1} and told['nodes'] == ['robot1.robot']
    other = world.look('log', 'robot1')
    fresh = other.wait_for('fresh')
    assert [line[1] for line in fresh['lines']] == [30, 40]


def test_error_pops_up(world: LiveWorld) -> None:
    """An error is shown in all browsers, whatever they look at."""
    page = world.visit('log')
    client = mock.Mock()
    with mock.patch.object(world.page.viser, 'get_clients', lambda: {1: client}):
        world.robot.get_logger().error('broken')
        page.wait_for('counts', lambda counts: '40' in counts)
        world.wait_until(lambda: client.add_notification.called, 'no notification')
    title, text = client.add_notification.call_args.args
    assert (title, text) == ('Error of robot1.robot', 'broken')


def test_diagnostics(world: LiveWorld) -> None:
    """The worst part comes first; parts become stale; one can be looked at closely."""
    page = world.visit('diagnostics', Namespace='robot1', **{'Stale After': 1.0})
    assert page.wait_for('rows', lambda rows: rows == [])['talking'] is False
    publisher = world.robot.create_publisher(DiagnosticArray, 'diagnostics', 10)
    world.wait_until(lambda: publisher.get_subscription_count() > 0, 'no subscription')
    for each in (status('good', 0), status('bad', 2, 'hot'), status('odd', 9)):
        publisher.publish(each)
    publisher.publish(DiagnosticArray())
    told = page.wait_for('rows', lambda rows: len(rows) == 3)
    assert [row[:2] for row in told['rows']] == [['bad', 2], ['odd', 2], ['good', 0]]
    page.ask('choose', name='bad')
    details = page.wait_for('details')['details']
    assert (details['message'], details['values']) == ('hot', [['volts', '24.1']])
    page.wait_for('rows', lambda rows: [row[1] for row in rows] == [3, 3, 3])
    page.ask('forget')
    page.told.clear()
    page.wait_for('rows', lambda rows: rows == [])


def test_command(world: LiveWorld) -> None:
    """What is typed reaches the robot; what it says, and its plan, reach the page."""
    assert not Command.is_wanted(world.robot)
    page = world.visit('command', Namespace='robot1')
    page.ask('tell', text='go to the kitchen')
    page.wait_for('refusal', lambda refusal: 'No one receives commands' in refusal)
    told: list[str] = []
    world.robot.create_subscription(
        String, 'user_command', lambda message: told.append(message.data), 50
    )
    world.wait_until(lambda: Command.is_wanted(world.robot), 'not wanted')
    speech = world.robot.create_publisher(String, 'speech/say', 50)
    state = world.robot.create_publisher(String, 'executor/state', LATCHED)
    world.wait_until(lambda: speech.get_subscription_count() > 0, 'nobody listens')
    time.sleep(0.3)
    page.ask('tell', text=' go to the kitchen ')
    world.wait_until(lambda: told == ['go to the kitchen'], 'not told', told)
    speech.publish(String(data='I am going.'))
    page.wait_for('lines', lambda lines: ['robot', 'I am going.'] in [each[1:] for each in lines])
    steps = [{'text': 'go to the kitchen', 'state': 'running'}]
    state.publish(String(data='no JSON'))
    state.publish(String(data=json.dumps({'state': 'running', 'steps': steps})))
    page.wait_for('plan', lambda plan: plan.get('steps') == steps)
    page.ask('stop')
    world.wait_until(lambda: told[-1] == 'stop', 'not stopped', told)
    for text in ('', '  ', 'x' * 501, 3, None):
        page.told.clear()
        page.ask('tell', text=text)
        page.wait_for('refusal')
    assert told == ['go to the kitchen', 'stop']
    fresh = world.look('command', 'robot1').wait_for('fresh')
    assert [line[1:] for line in fresh['lines']] == [
        ['you', 'go to the kitchen'], ['robot', 'I am going.'], ['you', 'stop'],
    ]  # fmt: skip


def test_push_to_talk(world: LiveWorld) -> None:
    """What the browser's microphone records reaches the recogniser; nonsense does not."""
    page = world.visit('command', Namespace='robot1')
    sound = base64.b64encode(bytes(range(200))).decode()
    page.ask('hear', sound=sound)
    page.wait_for('refusal', lambda refusal: 'No one is listening' in refusal)
    heard: list[bytes] = []
    world.robot.create_subscription(
        AudioData, 'audio', lambda message: heard.append(message.data.tobytes()), 50
    )
    world.wait_until(lambda: world.robot.count_publishers('audio') > 0, 'no publisher')
    time.sleep(0.3)
    for nonsense in ('', 'x', '%%%%', 3, None, 'AAAA', 'A' * 200_000):
        page.told.clear()
        page.ask('hear', sound=nonsense)
        if nonsense:
            page.wait_for('refusal')
    page.ask('hear', sound=sound)
    world.wait_until(lambda: bytes(range(200)) in heard, 'not heard', heard)
    assert all(each in (b'', bytes(range(200))) for each in heard)


def detection(name: str, *classes: str) -> Detection3D:
    """Return an object 1 m before the map's origin."""
    found = Detection3D(id=name)
    for each in classes:
        result = ObjectHypothesisWithPose()
        result.hypothesis.class_id, result.hypothesis.score = each, 0.875
        result.pose.covariance[0] = result.pose.covariance[7] = result.pose.covariance[14] = 4e-4
        found.results.append(result)
    found.bbox.center.position.x, found.bbox.size.z = 1.0, math.nan
    return found


def test_objects(world: LiveWorld) -> None:
    """What is remembered is listed by id; the panel is wanted as soon as somebody publishes it."""
    assert not Objects.is_wanted(world.robot)
    publisher = world.robot.create_publisher(Detection3DArray, 'objects', LATCHED)
    found = [detection('mug_2', 'mug', 'red mug'), detection('book_1', 'book'), detection('x')]
    publisher.publish(Detection3DArray(header=Header(frame_id='map'), detections=found))
    world.wait_until(lambda: Objects.is_wanted(world.robot), 'not wanted')
    page = world.visit('objects', Namespace='robot1')
    told = page.wait_for('objects', lambda rows: len(rows) == 3)
    assert told['frame'] == 'map' and told['left_out'] == 0
    assert [(row['id'], row['name']) for row in told['objects']] == [
        ('book_1', 'book'), ('mug_2', 'red mug'), ('x', ''),
    ]  # fmt: skip
    mug, unknown = told['objects'][1:]
    assert (mug['position'], mug['size']) == ([1.0, 0.0, 0.0], [0.0, 0.0, None])
    assert (mug['score'], mug['spread']) == (0.875, 0.02)
    assert (unknown['score'], unknown['spread']) == (None, None)
    publisher.publish(Detection3DArray(header=Header(frame_id='map')))
    page.wait_for('objects', lambda rows: not rows)
    other = world.look('objects', 'robot1')
    other.wait_for('heard')


def test_objects_of_another_type(world: LiveWorld) -> None:
    """A topic of that name with other messages does not bring the panel."""
    world.robot.create_publisher(String, 'objects', LATCHED)
    world.wait_until(lambda: world.robot.count_publishers('/robot1/objects') > 0, 'no publisher')
    assert not Objects.is_wanted(world.robot)


def test_topics(world: LiveWorld) -> None:
    """Topics are listed; one is subscribed only while somebody has chosen it."""
    publisher = world.robot.create_publisher(String, 'words', LATCHED)
    publisher.publish(String(data='from before'))
    page = world.visit('topics', Namespace='robot1')
    row = ['/robot1/words', 'std_msgs/msg/String', 1, 0]
    page.wait_for('rows', lambda rows: row in rows)
    assert publisher.get_subscription_count() == 0
    page.ask('choose', topic='/robot1/words')
    told = page.wait_for('details', lambda details: bool(details.get('text')))['details']
    assert told['text'] == 'data: from before\n' and told['size'] > 0
    assert told['publishers'] == [['/robot1/robot', 'reliable, transient local']]
    assert told['reasons'] == []
    page.connection.close()
    world.wait_until(lambda: publisher.get_subscription_count() == 0, 'still subscribed')


def test_rates(world: LiveWorld) -> None:
    """Rates of all topics are measured while somebody wants them."""
    publisher = world.robot.create_publisher(String, 'words', 10)
    world.robot.create_timer(0.05, lambda: publisher.publish(String(data='hi')))
    page = world.visit('topics')
    page.wait_for('rows')
    assert publisher.get_subscription_count() == 0
    page.ask('rates', on=True)
    page.wait_for('rates', lambda rates: 'Hz' in rates.get('/robot1/words', ''))
    page.ask('rates', on=False)
    world.wait_until(lambda: publisher.get_subscription_count() == 0, 'still subscribed')


def test_mismatch(world: LiveWorld) -> None:
    """Two ends between which nothing passes are named with the reason."""
    best_effort = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    world.robot.create_publisher(String, 'words', best_effort)
    world.robot.create_subscription(String, 'words', print, 10)
    page = world.visit('topics')
    page.wait_for('rows', lambda rows: any(row[0] == '/robot1/words' for row in rows))
    page.ask('choose', topic='/robot1/words')
    told = page.wait_for('details', lambda details: bool(details.get('reasons')))
    (reason,) = told['details']['reasons']
    assert reason.startswith('Nothing passes from /robot1/robot to /robot1/robot: ')
    page.ask('choose', topic='/nothing')
    page.wait_for('details', lambda details: details == {'topic': '/nothing'})
    # One subscription of a node that fits is enough.
    world.robot.create_subscription(String, 'words', print, best_effort)
    page.ask('choose', topic='/robot1/words')
    page.wait_for('details', lambda details: details.get('reasons') == [])
    page.ask('choose', topic='/nothing')
    page.wait_for('details', lambda details: details == {'topic': '/nothing'})


def robot_with_parameters(world: LiveWorld) -> None:
    """Give the robot a parameter, of which it does not take all values."""
    about = ParameterDescriptor(
        description='How fast.', floating_point_range=[FloatingPointRange(to_value=9.0)]
    )
    world.robot.declare_parameter('speed', 1.0, about)

    def check(parameters: list[Parameter]) -> SetParametersResult:
        if parameters[0].value == 3.0:
            return SetParametersResult(successful=False, reason='three is too much')
        return SetParametersResult(successful=True)

    world.robot.add_on_set_parameters_callback(check)


def test_parameters(world: LiveWorld) -> None:
    """A parameter is changed; the page or the node refuse with their reasons."""
    robot_with_parameters(world)
    page = world.visit('parameters', Namespace='robot1')
    page.wait_for('nodes', lambda nodes: nodes == ['/robot1/robot'])
    page.ask('choose', node='/robot1/robot')
    told = page.wait_for('parameters', bool)['parameters']['speed']
    assert (told['text'], told['about']) == ('1.0', 'How fast.')
    for text, reason in (
        ('fast', 'must be a number'),
        ('10', 'from 0 to 9'),
        ('3', 'Rejected: three is too much'),
    ):
        page.ask('set', node='/robot1/robot', name='speed', text=text)
        page.wait_for('refused', lambda refused, reason=reason: reason in refused)  # type: ignore
    assert world.robot.get_parameter('speed').value == 1.0
    page.ask('set', node='/robot1/robot', name='speed', text='2')
    page.wait_for('changed', lambda changed: changed['speed']['text'] == '2.0')
    assert world.robot.get_parameter('speed').value == 2.0
    page.ask('set', node='/robot1/robot', name='sped', text='2')
    page.wait_for('refused', lambda refused: 'no longer exists' in refused)


def test_parameter_of_others(world: LiveWorld) -> None:
    """What others change, and new parameters, are shown."""
    robot_with_parameters(world)
    page = world.visit('parameters')
    page.wait_for('nodes', lambda nodes: '/robot1/robot' in nodes)
    page.ask('choose', node='/robot1/robot')
    page.wait_for('parameters', bool)
    world.wait_until(
        lambda: world.robot.count_subscribers('/parameter_events') > 0, 'nobody listens'
    )
    time.sleep(0.3)
    world.robot.set_parameters([Parameter('speed', value=4.0)])
    page.wait_for('changed', lambda changed: changed['speed']['text'] == '4.0')
    world.robot.declare_parameter('later', 'x')
    page.wait_for('parameters', lambda told: 'later' in told)
    page.ask('choose', node='/nobody')
    page.wait_for('problem', lambda problem: "no longer a node '/nobody'" in problem)


def test_services(world: LiveWorld) -> None:
    """A service is called with what was typed, and its answer or its failure shown."""

    def switch(request: Any, response: Any) -> Any:
        response.success, response.message = request.data, 'done'
        return response

    service = world.robot.create_service(SetBool, 'switch', switch)
    page = world.visit('services', Namespace='robot1', Timeout=1.0)
    row = ['/robot1/switch', 'std_srvs/srv/SetBool', True]
    page.wait_for('rows', lambda rows: row in rows)
    page.ask('choose', service='/robot1/switch')
    told = page.wait_for('template')
    assert told['template'] == 'data: false\n' and told['offered_by'] == ['/robot1/robot']
    page.ask('call', service='/robot1/switch', text='data: true', number=1)
    assert page.wait_for('number', lambda n: n == 1)['text'] == 'success: true\nmessage: done\n'
    page.ask('call', service='/robot1/switch', text='dat: true', number=2)
    assert "'dat'" in page.wait_for('number', lambda n: n == 2)['failed']
    page.ask('call', service='/robot1/nothing', text='', number=3)
    assert 'no longer exists' in page.wait_for('number', lambda n: n == 3)['failed']
    client = world.node.create_client(SetBool, '/robot1/silent')
    page.wait_for('rows', lambda rows: ['/robot1/silent', 'std_srvs/srv/SetBool', False] in rows)
    page.ask('call', service='/robot1/silent', text='', number=4)
    failed = page.wait_for('number', lambda n: n == 4)['failed']
    assert failed == "No server for '/robot1/silent'."
    world.node.destroy_client(client)
    world.robot.destroy_service(service)


def test_service_that_does_not_answer(world: LiveWorld) -> None:
    """A call that is not answered ends with a sentence, and blocks nothing."""
    other = RosContext()
    rclpy.init(context=other, domain_id=world.ros.get_domain_id())
    dead = Node('dead', context=other)
    dead.create_service(SetBool, '/stuck', lambda request, response: response)
    page = world.visit('services', Timeout=1.0)
    page.wait_for('rows', lambda rows: any(row[0] == '/stuck' for row in rows))
    page.ask('call', service='/stuck', text='', number=1)
    failed = page.wait_for('number', lambda n: n == 1)['failed']
    assert failed == "'/stuck' did not respond within 1 s."
    dead.destroy_node()
    other.try_shutdown()


def list_scenes(request: Any, response: Any) -> Any:
    """Answer which scenes can be loaded."""
    for name in ('room', 'flat'):
        response.worlds.append(WorldResource(name=name, world_resource=Resource(uri=name)))
    response.result.result = Result.RESULT_OK
    return response


class Simulator:
    """Services of a simulator that loads, pauses and resets, but never steps."""

    def __init__(self, node: Node) -> None:
        self.asked: list[str] = []
        self.state, self.world = SimulationState.STATE_PLAYING, 'flat'
        for kind, name, answer in (
            (GetSimulationState, 'get_simulation_state', self._tell),
            (SetSimulationState, 'set_simulation_state', self._set),
            (ResetSimulation, 'reset_simulation', self._note),
            (StepSimulation, 'step_simulation', self._refuse),
            (GetAvailableWorlds, 'get_available_worlds', list_scenes),
            (GetCurrentWorld, 'get_current_world', self._tell_world),
            (LoadWorld, 'load_world', self._load),
        ):
            node.create_service(kind, f'/simulator/{name}', answer)
        node.create_service(Trigger, 'stand_up', self._lift)

    def _note(self, request: Any, response: Any) -> Any:
        self.asked.append(type(request).__qualname__)
        response.result.result = Result.RESULT_OK
        return response

    def _refuse(self, request: Any, response: Any) -> Any:
        response.result.error_message = f'{request.steps} steps are too many.'
        return response

    def _tell(self, request: Any, response: Any) -> Any:
        response.state.state = self.state
        return response

    def _set(self, request: Any, response: Any) -> Any:
        self.state = request.state.state
        return self._note(request, response)

    def _tell_world(self, request: Any, response: Any) -> Any:
        response.world.world_resource.uri = self.world
        response.result.result = Result.RESULT_OK
        return response

    def _load(self, request: Any, response: Any) -> Any:
        self.world, self.state = request.uri, SimulationState.STATE_STOPPED
        return self._note(request, response)

    def _lift(self, request: Any, response: Any) -> Any:
        self.asked.append('stand_up')
        response.success = True
        return response


def test_simulator_in_the_namespace_of_the_console(world: LiveWorld) -> None:
    """A console in the namespace of a robot has the simulator of this robot."""
    services = {f'{name}/reset_simulation' for name in ('/simulator', '/robot1/a', '/robot2/a')}
    for service in services:
        world.robot.create_service(ResetSimulation, service, print)
    console = Node('console', namespace='robot1', context=world.ros)
    world.wait_until(lambda: all(map(console.count_services, services)), 'not discovered')
    link = SimulatorLink(console, ServiceCalls(console), '', '')
    link.update()
    assert "'/robot1/a/load_world'" in link.why_not('load_world')
    link.close()
    console.destroy_node()


def said(*texts: str) -> Any:
    """Return what holds for words of a state that are these."""
    return lambda found: [text for text, _ in found] == list(texts)


def test_robot_without_a_simulator(world: LiveWorld) -> None:
    """Each button is disabled with its reason; the state is that of the robot and its stop."""
    page = world.visit('robot', Namespace='robot1')
    told = page.wait_for('words', said('The robot does not report its state'))
    assert "no service '/robot1/stand_up'" in told['why']['stand_up']
    for button in ('reset', 'pause', 'step', 'world'):
        assert told['why'][button].startswith('No simulator is running')
    page.ask('reset')
    page.wait_for('refusal', lambda refusal: refusal.startswith('No simulator is running'))
    state = world.robot.create_publisher(String, 'walking_state', LATCHED)
    state.publish(String(data='fallen'))
    page.wait_for('words', said('Fallen: hold it upright'))
    stop = world.robot.create_publisher(Bool, 'emergency_stop', LATCHED)
    stop.publish(Bool(data=True))
    pressed = 'Stop pressed by /robot1/robot; the robot has not confirmed it'
    page.wait_for('words', said(pressed, 'Fallen: hold it upright'))
    holds = world.robot.create_publisher(String, 'stop_state', LATCHED)
    holds.publish(String(data='the emergency stop is pressed'))
    page.wait_for('words', said('Stopped by /robot1/robot', 'Fallen: hold it upright'))
    holds.publish(String(data=''))
    stop.publish(Bool(data=False))
    state.publish(String(data='stand'))
    page.wait_for('words', said('Ready'))
    world.robot.destroy_publisher(state)
    page.told.clear()
    page.wait_for('words', said('The robot does not report its state'))


def test_robot_with_a_simulator(world: LiveWorld) -> None:
    """The buttons call the services; a rejection is shown, and what is paused."""
    simulator = Simulator(world.robot)
    state = world.robot.create_publisher(String, 'walking_state', LATCHED)
    state.publish(String(data='fallen'))
    page = world.visit('robot', Namespace='robot1', Steps=7)
    page.wait_for('words', said('Fallen: press Stand up'))
    told = page.wait_for('world', lambda name: name == 'flat')
    told = page.wait_for('worlds', lambda worlds: [each[1] for each in worlds] == ['flat', 'room'])
    assert {button for button, why in told['why'].items() if why} == {'step'}
    for button in ('stand_up', 'reset'):
        page.told.clear()
        page.ask(button)
        assert page.wait_for('said', lambda reason: reason == '')
    assert simulator.asked == ['stand_up', 'ResetSimulation_Request']
    state.publish(String(data='stand'))
    page.ask('pause')
    told = page.wait_for('words', said('Paused'))
    assert told['paused'] and not told['why']['step']
    page.ask('step')
    page.wait_for('said', lambda reason: reason == '7 steps are too many.')
    page.ask('play')
    page.wait_for('words', said('Ready'))


def test_scenes(world: LiveWorld) -> None:
    """A scene that is chosen is shown, and runs at once unless the last one was paused."""
    simulator = Simulator(world.robot)
    page = world.visit('robot')
    page.wait_for('worlds', bool)
    page.ask('world', uri='moon')
    page.wait_for('refusal', lambda refusal: 'no longer offers' in refusal)
    world.wait_until(lambda: world.panels[0]._simulator.state == 1, 'not playing')
    page.ask('world', uri='room')
    page.wait_for('world', lambda name: name == 'room')
    world.wait_until(lambda: simulator.state == SimulationState.STATE_PLAYING, 'not playing')
    page.ask('pause')
    page.wait_for('words', said('Paused'))
    for scene in ('flat', 'room'):
        page.told.clear()
        page.ask('world', uri=scene)
        page.wait_for('world', lambda name, scene=scene: name == scene)
        page.wait_for('words', said('Paused at the start'))
    assert simulator.asked[-2:] == ['LoadWorld_Request'] * 2


def test_simulator_that_does_not_respond(
    world: LiveWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The robot is not called ready; while a scene is loaded, silence is expected."""
    monkeypatch.setattr(simulator_link, 'SILENCE_S', 0.1)
    other = RosContext()
    rclpy.init(context=other, domain_id=world.ros.get_domain_id())
    node = Node('simulator', context=other)  # does not spin
    node.create_service(GetSimulationState, '~/get_simulation_state', print)
    node.create_service(LoadWorld, '~/load_world', print)
    name = '/simulator/get_available_worlds'
    world.robot.create_service(GetAvailableWorlds, name, list_scenes)
    state = world.robot.create_publisher(String, 'walking_state', LATCHED)
    state.publish(String(data='stand'))
    page = world.visit('robot', Namespace='robot1')
    told = page.wait_for('words', said('The simulator does not respond'))
    assert not told['paused']
    page.wait_for('worlds', bool)
    page.ask('world', uri='flat')
    page.wait_for('words', said('Loading the scene'))
    page.told.clear()
    node.destroy_node()
    page.wait_for('words', said('Ready'))
    other.try_shutdown()


def test_robot_that_is_as_it_was(world: LiveWorld) -> None:
    """A viewer who comes while the robot is down sees that it is again as it was before."""
    state = world.robot.create_publisher(String, 'walking_state', LATCHED)
    state.publish(String(data='stand'))
    world.visit('robot', Namespace='robot1').wait_for('words', said('Ready'))
    panel: Any = world.panels[0]
    panel._pace = panel._look = mock.Mock(is_due=mock.Mock(return_value=False))
    state.publish(String(data='fallen'))
    world.wait_until(lambda: panel._walking == 'fallen', 'not fallen')
    page = world.look('robot', 'robot1')
    page.wait_for('words', said('Fallen: hold it upright'))
    state.publish(String(data='stand'))
    world.wait_until(lambda: panel._walking == 'stand', 'still fallen')
    panel.refresh()
    page.wait_for('words', said('Ready'))


def test_where_the_robot_was_stopped(world: LiveWorld) -> None:
    """Each page says whether it was this page or another browser that stopped the robot."""
    world.start('robot')
    link = link_of(world.context, '')
    ann = link.people.arrive('ann', '10.0.0.1')
    link.people.arrive('ben', '10.0.0.1')
    link.say_stop(True, ann)
    address = f'ws://127.0.0.1:{world.page.port}/robot'
    for key, words in (('ann', 'in this page'), ('ben', 'in another browser')):
        page = Browser(world, f'{address}?me={key}')
        pressed = f'Stop pressed {words}; the robot has not confirmed it'
        page.wait_for('words', said(pressed))


def test_title_of_the_page(world: LiveWorld) -> None:
    """The page has the title of the panel as long as the panel is shown."""

    def title() -> str:
        connection = HTTPConnection('127.0.0.1', world.page.port, timeout=100)
        connection.request('GET', '/')
        return connection.getresponse().read().decode().partition('<title>')[2].partition('<')[0]

    world.start('robot', Title='Humanoid')
    assert title() == 'Humanoid'
    world.panels.pop().close()
    assert title() == 'test'


@pytest.mark.parametrize('name', PANELS)
def test_small_page(world: LiveWorld, name: str) -> None:
    """The pages are complete, and ask nobody else for anything."""
    world.visit(name)
    connection = HTTPConnection('127.0.0.1', world.page.port, timeout=100)
    connection.request('GET', f'/{name}')
    text = connection.getresponse().read().decode()
    assert 'class Feed' in text and '--line:' in text and '.split' in text
    assert 'http://' not in text and 'https://' not in text
    assert 'innerHTML' not in text, 'texts of others must stay texts'


@pytest.mark.parametrize('name', PANELS)
def test_begin_anew(world: LiveWorld, name: str) -> None:
    """A panel that is closed leaves nothing, so that another file can have it again."""
    world.visit(name)
    before = len(list(world.node.subscriptions)), len(list(world.node.clients))
    world.panels.pop().close()
    world.visit(name)
    assert (len(list(world.node.subscriptions)), len(list(world.node.clients))) == before
