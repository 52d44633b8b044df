# SPDX-License-Identifier: Apache-2.0
"""Tests of who reaches nodes over a network: two machines, made of network namespaces.

Each way of discovery is tried with nodes, which talk, and with `ros2`, which lists them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import json
import os
from pathlib import Path
import shutil
import subprocess
import sys

from programs import Program
import pytest

Start = Callable[..., Program]
ROBOT, OTHER = '10.231.7.1', '10.231.7.2'
SERVER_PORT = 11811
TIMEOUT_S = 90.0
DOMAIN = 41
FIRST_PORT, LAST_PORT = 7400 + 250 * DOMAIN, 7400 + 250 * (DOMAIN + 1)
ANYWHERE, LOOPBACK = '00000000', '0100007F'

# Publishes NAME/out, and says when it is driven by way of NAME/command.
NODE = """
import sys
import rclpy
from std_msgs.msg import String

rclpy.init()
name = sys.argv[1]
node = rclpy.create_node(name)
out = node.create_publisher(String, f'{name}/out', 10)
said = []

def hear(message):
    if not said:
        said.append(print('driven by', message.data, flush=True))

node.create_subscription(String, f'{name}/command', hear, 10)
node.create_timer(0.02, lambda: out.publish(String(data=name)))
print('ready', flush=True)
rclpy.spin(node)
"""

# Drives and listens to the nodes that are named, until it has heard enough of each that it must
# hear, and they have acknowledged its commands; then it prints whom it sees and has heard.
VISITOR = """
import json, sys, time
import rclpy
from rclpy.duration import Duration
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node('visitor')
names, must = sys.argv[1].split(','), set(sys.argv[2].split(','))
heard = dict.fromkeys(names, 0)

def hear(message):
    heard[message.data] += 1

for name in names:
    node.create_subscription(String, f'{name}/out', hear, 10)
commands = {name: node.create_publisher(String, f'{name}/command', 10) for name in names}

def is_done(name):
    driven = commands[name]
    return (
        heard[name] >= 100
        and driven.get_subscription_count() > 0
        and driven.wait_for_all_acked(Duration(seconds=0.1))
    )

end_s = time.monotonic() + 60.0
while not all(map(is_done, must)) and time.monotonic() < end_s:
    for each in commands.values():
        each.publish(String(data='visitor'))
    rclpy.spin_once(node, timeout_sec=0.05)
seen = sorted({*node.get_node_names()} - {'visitor'})
print(json.dumps({'seen': seen, 'heard': [name for name in names if heard[name]]}), flush=True)
"""

# Prints the kernel's table of this machine's UDP sockets.
SOCKETS = """
import rclpy

rclpy.init()
node = rclpy.create_node('sockets')
print(open('/proc/self/net/udp').read())
"""


@dataclass(frozen=True)
class Machine:
    """A network namespace with a folder in place of /dev/shm."""

    name: str
    shared_memory: Path

    def command(self, *words: str, memory: bool = True) -> list[str]:
        """Return the command that runs another one on this machine."""
        folder = str(self.shared_memory) if memory else '/proc/self/fdinfo'  # nobody writes there
        script = 'mount --bind "$0" /dev/shm && exec "$@"'
        return ['ip', 'netns', 'exec', self.name, 'sh', '-c', script, folder, *words]


def ip(*words: str) -> None:
    """Run a command of iproute2."""
    subprocess.run(['ip', *words], check=True, capture_output=True, text=True)


@pytest.fixture
def namespaces(tmp_path: Path) -> Iterator[tuple[Machine, Machine]]:
    """Make the robot's machine and another one, without a network between them."""
    if os.geteuid() != 0 or shutil.which('ip') is None:
        pytest.skip('network namespaces need root, and iproute2')
    made = [Machine(f'{end}-{os.getpid()}', tmp_path / end) for end in ('robot', 'other')]
    try:
        for machine in made:
            try:
                ip('netns', 'add', machine.name)
            except subprocess.CalledProcessError as error:
                pytest.skip(f'no network namespaces here: {error.stderr.strip()}')
            machine.shared_memory.mkdir()
            ip('-n', machine.name, 'link', 'set', 'lo', 'up')
        yield made[0], made[1]
    finally:
        for machine in made:
            subprocess.run(['ip', 'netns', 'del', machine.name], capture_output=True, check=False)


@pytest.fixture
def machines(namespaces: tuple[Machine, Machine]) -> tuple[Machine, Machine]:
    """Connect the two machines by a cable."""
    link = ['link', 'add', 'e0', 'netns', namespaces[0].name, 'type', 'veth']
    ip(*link, 'peer', 'name', 'e0', 'netns', namespaces[1].name)
    for machine, address in zip(namespaces, (ROBOT, OTHER), strict=True):
        ip('-n', machine.name, 'addr', 'add', f'{address}/24', 'dev', 'e0')
        ip('-n', machine.name, 'link', 'set', 'e0', 'up')
        ip('-n', machine.name, 'route', 'add', 'default', 'dev', 'e0')
    return namespaces


@pytest.fixture
def connect(
    start: Start, root: Path, namespaces: tuple[Machine, Machine]
) -> Callable[..., tuple[Machine, Machine]]:
    """Return a function that connects the two machines by a network that is not a good one."""
    if not os.access('/dev/net/tun', os.R_OK | os.W_OK):
        pytest.skip('a network that loses packets needs /dev/net/tun')

    def connect(*options: str) -> tuple[Machine, Machine]:
        ends = [f'{each.name}/{address}' for each, address in zip(namespaces, (ROBOT, OTHER))]
        program = str(root / 'tools' / 'test' / 'bad_link.py')
        start(sys.executable, program, *ends, *options).wait_for('The link is up')
        return namespaces

    return connect


def reach(extent: str, **more: str) -> dict[str, str]:
    """Return an environment in which discovery goes so far."""
    network = ('ROS_AUTOMATIC_DISCOVERY_RANGE', 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER')
    rest = {name: value for name, value in os.environ.items() if name not in network}
    return {**rest, 'ROS_DOMAIN_ID': str(DOMAIN), 'ROS_AUTOMATIC_DISCOVERY_RANGE': extent, **more}


def start_node(start: Start, machine: Machine, name: str, env: dict[str, str]) -> Program:
    """Start a node and wait until it is there."""
    node = start(*machine.command(sys.executable, '-c', NODE, name), env=env)
    node.wait_for('ready', TIMEOUT_S)
    return node


def visit(machine: Machine, names: str, must: str, env: dict[str, str]) -> dict[str, list[str]]:
    """Return whom a program on a machine sees and hears while it tries to drive all of them."""
    command = machine.command(sys.executable, '-c', VISITOR, names, must)
    done = subprocess.run(
        command, env=env, capture_output=True, text=True, timeout=TIMEOUT_S, check=True
    )
    found: dict[str, list[str]] = json.loads(done.stdout)
    return found


def listed(machine: Machine, env: dict[str, str]) -> list[str]:
    """Return the nodes that `ros2` lists on a machine, which it does without a warning."""
    done = subprocess.run(
        machine.command('ros2', 'node', 'list'),
        env=env,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=True,
    )
    assert done.stderr == ''
    return done.stdout.splitlines()


def test_localhost_is_closed_to_other_machines(
    start: Start, machines: tuple[Machine, Machine]
) -> None:
    """Who names the robot as a static peer sees and drives only what was opened."""
    robot, other = machines
    closed = start_node(start, robot, 'closed', reach('LOCALHOST'))
    start_node(start, robot, 'open', reach('SUBNET'))
    for extent in ('SUBNET', 'LOCALHOST'):
        must = 'open' if extent == 'SUBNET' else 'own'
        env = reach(extent, ROS_STATIC_PEERS=ROBOT)
        if extent == 'LOCALHOST':
            start_node(start, other, 'own', env)
        found = visit(other, f'closed,{must}', must, env)
        assert found == {'seen': [must], 'heard': [must]}
    assert 'driven' not in closed.output


def test_localhost_stays_closed_when_it_names_the_other(
    start: Start, machines: tuple[Machine, Machine]
) -> None:
    """With LOCALHOST static peers of one's own open nothing: they are for SUBNET."""
    robot, other = machines
    closed = start_node(start, robot, 'closed', reach('LOCALHOST', ROS_STATIC_PEERS=OTHER))
    start_node(start, robot, 'open', reach('SUBNET', ROS_STATIC_PEERS=OTHER))
    found = visit(other, 'closed,open', 'open', reach('SUBNET', ROS_STATIC_PEERS=ROBOT))
    assert found == {'seen': ['open'], 'heard': ['open']}
    assert 'driven' not in closed.output


def test_subnet_reaches_other_machines(start: Start, machines: tuple[Machine, Machine]) -> None:
    """Who asks for the network has it, by multicast."""
    robot, other = machines
    node = start_node(start, robot, 'open', reach('SUBNET'))
    assert listed(other, reach('SUBNET')) == ['/open']
    assert visit(other, 'open', 'open', reach('SUBNET')) == {'seen': ['open'], 'heard': ['open']}
    node.wait_for('driven')


def test_static_peers(start: Start, connect: Callable[..., tuple[Machine, Machine]]) -> None:
    """Where multicast does not get through, it is enough that one names the other."""
    robot, other = connect('--unicast')
    node = start_node(start, robot, 'open', reach('SUBNET'))
    assert listed(other, reach('SUBNET')) == []
    env = reach('SUBNET', ROS_STATIC_PEERS=ROBOT)
    assert listed(other, env) == ['/open']
    assert visit(other, 'open', 'open', env) == {'seen': ['open'], 'heard': ['open']}
    node.wait_for('driven')


def start_server(start: Start, machine: Machine) -> dict[str, str]:
    """Start a discovery server on the robot's machine; return the environment that uses it."""
    server = ['fast-discovery-server', '-i', '0', '-l', ROBOT, '-p', str(SERVER_PORT)]
    start(*machine.command(*server), env=reach('SUBNET')).wait_for('Server is', TIMEOUT_S)
    return reach('SUBNET', ROS_DISCOVERY_SERVER=f'{ROBOT}:{SERVER_PORT}')


@pytest.mark.parametrize(
    'options',
    [(), ('--delay', '0.05', '--loss', '0.02')],
    ids=['near', 'far'],
)
def test_discovery_server(
    start: Start, connect: Callable[..., tuple[Machine, Machine]], options: tuple[str, ...]
) -> None:
    """A server brings machines together without multicast, late packets and lost ones or not."""
    robot, other = connect('--unicast', *options)
    env = start_server(start, robot)
    node = start_node(start, robot, 'open', env)
    assert listed(other, env) == ['/open']
    assert visit(other, 'open', 'open', env)['heard'] == ['open']
    node.wait_for('driven')


@pytest.mark.parametrize('memory', [True, False])
@pytest.mark.parametrize('extents', [('LOCALHOST', 'LOCALHOST'), ('LOCALHOST', 'SUBNET')])
def test_one_machine(
    start: Start, machines: tuple[Machine, Machine], extents: tuple[str, str], memory: bool
) -> None:
    """On one machine all find each other, also where there is no shared memory."""
    robot, _ = machines
    command = robot.command(sys.executable, '-c', NODE, 'near', memory=memory)
    node = start(*command, env=reach(extents[0]))
    node.wait_for('ready', TIMEOUT_S)
    command = robot.command(sys.executable, '-c', VISITOR, 'near', 'near', memory=memory)
    done = subprocess.run(
        command, env=reach(extents[1]), stdout=subprocess.PIPE, timeout=TIMEOUT_S, check=True
    )
    assert json.loads(done.stdout) == {'seen': ['near'], 'heard': ['near']}
    node.wait_for('driven')


@pytest.mark.parametrize(
    ('extent', 'hosts'),
    [
        ('LOCALHOST', {LOOPBACK}),
        ('OFF', {LOOPBACK}),
        ('SUBNET', {ANYWHERE}),
        ('SYSTEM_DEFAULT', {ANYWHERE}),
        ('', {ANYWHERE}),
    ],
)
def test_sockets(extent: str, hosts: set[str]) -> None:
    """A node hears where the range says that it does, whenever the variable was set."""
    done = subprocess.run(
        [sys.executable, '-c', SOCKETS],
        env=reach(extent),
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=True,
    )
    addresses = [row.split()[1].split(':') for row in done.stdout.splitlines()[1:] if row.strip()]
    found = {host for host, port in addresses if FIRST_PORT <= int(port, 16) < LAST_PORT}
    assert found == hosts
    assert 'XMLPARSER' not in done.stderr
