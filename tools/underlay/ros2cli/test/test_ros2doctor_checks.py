# SPDX-License-Identifier: Apache-2.0
"""Tests of what the checks find in given facts; nothing of this machine is looked at."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
import errno
import fcntl
from pathlib import Path
import shlex
import subprocess
from types import SimpleNamespace
from typing import Any

import pytest
from ros2cli.graph.probe import Answer
from ros2cli.graph.reach import Interface
from ros2cli.graph.servers import Server
from ros2doctor.api.extension import Finding, Severity
from ros2doctor.check.clock import clock_findings
from ros2doctor.check.environment import Environment, environment_findings
from ros2doctor.check.frames import frame_findings, FramesCheck
from ros2doctor.check.graph import client_library_findings, Endpoint, Graph
from ros2doctor.check.graphics import Graphics, graphics_findings
from ros2doctor.check.libraries import Libraries, library_findings, LibraryFolder
from ros2doctor.check.listening import DiagnosticsListener, Transform
from ros2doctor.check.network import Network, network_findings, who_reaches
from ros2doctor.check.nodes import (
    diagnostics_findings,
    name_findings,
    namespace_findings,
    NeighboursCheck,
)
from ros2doctor.check.qos import pair_findings
from ros2doctor.check.scripts import mending_command, Script, script_findings
from ros2doctor.check.servers import (
    Discovery,
    server_findings,
    ServersCheck,
    ServersReport,
    why_no_graph,
)
from ros2doctor.check.transports import CLEAN_UP, read_shared_memory, SharedMemory
from ros2doctor.check.wheels import install_command, wheel_findings, Wheels
from ros2doctor.check.workspace import PackageState, Workspace, workspace_findings
import yaml

SET_UP = 'source install/setup.bash'
LOOPBACK = Interface('lo', '127.0.0.1', True, True, False)
CABLE = Interface('eth0', '192.0.2.1', True, False, True)


def sentences(findings: Iterable[Finding]) -> list[str]:
    """Return what is wrong, each with its severity; all findings say why and what mends them."""
    found = list(findings)
    assert all(finding.why and finding.mend for finding in found)
    return [f'{finding.severity.value}: {finding.what}' for finding in found]


@pytest.fixture
def environment(tmp_path: Path) -> Environment:
    """Return an environment without a fault."""
    return Environment(
        variables={
            'AMENT_PREFIX_PATH': str(tmp_path),
            'ROS_DISTRO': 'jazzy',
            'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp',
        },
        python_version=(3, 12),
        prefix=str(tmp_path),
        rclpy=f'{tmp_path}/lib/rclpy/__init__.py',
        other_python=None,
        colcon=None,
        has_current_folder=True,
        set_up=SET_UP,
    )


def test_environment_without_fault(environment: Environment) -> None:
    """There is nothing to say about a complete environment."""
    assert sentences(environment_findings(environment)) == []


@pytest.mark.parametrize(
    'variables, sentence',
    [
        ({'AMENT_PREFIX_PATH': ''}, 'ERROR: no ROS 2 environment is sourced in this terminal'),
        ({'ROS_DISTRO': 'humble'}, "ERROR: ROS_DISTRO is 'humble' instead of 'jazzy'"),
        ({'RMW_IMPLEMENTATION': 'rmw_x'}, "ERROR: RMW_IMPLEMENTATION is 'rmw_x', for which PyPI"),
        (
            {'PYTHONPATH': '/opt/ros/jazzy/lib'},
            "ERROR: PYTHONPATH also contains another ROS, '/opt",
        ),
        ({'COLCON_PREFIX_PATH': '/gone'}, "WARNING: COLCON_PREFIX_PATH names the folder '/gone'"),
    ],
)
def test_variables(environment: Environment, variables: dict[str, str], sentence: str) -> None:
    """Each wrong variable is named with its value."""
    changed = replace(environment, variables={**environment.variables, **variables})
    found = sentences(environment_findings(changed))
    assert [text[: len(sentence)] for text in found] == [sentence]


@pytest.mark.parametrize(
    'change, sentence',
    [
        ({'python_version': (3, 14)}, 'ERROR: this is Python 3.14'),
        (
            {'rclpy': '/usr/lib/rclpy.py'},
            "ERROR: rclpy would be imported from '/usr/lib/rclpy.py'",
        ),
        ({'has_current_folder': False}, 'WARNING: the current folder of this terminal has been'),
        ({'other_python': '/conda/python3'}, "ERROR: `python3` is '/conda/python3', outside of"),
        (
            {'colcon': Script('/usr/bin/colcon', '/usr/bin/python3', True, True, True, False)},
            "WARNING: `colcon` is '/usr/bin/colcon', which runs with '/usr/bin/python3'",
        ),
    ],
)
def test_programs(environment: Environment, change: dict[str, Any], sentence: str) -> None:
    """A Python, an rclpy and a colcon of another installation are named."""
    found = sentences(environment_findings(replace(environment, **change)))
    assert [text[: len(sentence)] for text in found] == [sentence]


def test_rclpy_that_does_not_start() -> None:
    """The reason is part of the sentence."""
    found = sentences(client_library_findings('ImportError: x', 'make setup'))
    assert found == ['ERROR: rclpy does not start: ImportError: x']
    assert sentences(client_library_findings('', 'make setup')) == []


def test_wheels() -> None:
    """Missing wheels and wrong ones of ROS are errors, other versions are warnings."""
    pinned = {'numpy': '2.0', 'ros-rcl': '9.2.8', 'xacro': '2.1'}
    installed = {'numpy': '2.1', 'ros-rcl': '9.2.7', 'setuptools': '80.1'}
    assert sentences(wheel_findings(Wheels(installed, pinned, Path('/w s'), 'make setup'))) == [
        'ERROR: wheels are missing: xacro',
        'ERROR: the versions of the ROS wheels do not match: ros-rcl 9.2.7 instead of 9.2.8',
        'WARNING: wheels have versions other than the tested ones: numpy 2.1 instead of 2.0',
    ]
    assert sentences(wheel_findings(Wheels(pinned, pinned, Path('/ws'), 'make setup'))) == []
    assert sentences(wheel_findings(Wheels(installed, {}, None, 'pip install'))) == [
        'WARNING: setuptools is 80.1'
    ]


def test_libraries() -> None:
    """A path without the own folder, with another ROS before it, or with conda, is named."""
    own = LibraryFolder('/venv/lib', True, ())
    other = LibraryFolder('/opt/ros/lib', True, ())
    conda = LibraryFolder('/conda/lib', False, ('libstdc++.so.6',))

    def found(*folders: LibraryFolder) -> list[str]:
        return sentences(library_findings(Libraries('/venv/lib', folders, True), SET_UP))

    assert found(own) == []
    assert found(own, other) == []
    assert found() == ["ERROR: LD_LIBRARY_PATH does not name '/venv/lib'"]
    assert found(other, own) == [
        "ERROR: LD_LIBRARY_PATH names '/opt/ros/lib' first, which has libraries of another ROS"
    ]
    assert found(own, conda) == [
        "WARNING: LD_LIBRARY_PATH names '/conda/lib', which has its own libstdc++.so.6"
    ]


def test_scripts_are_grouped_by_interpreter() -> None:
    """One finding names all scripts with the same wrong interpreter."""
    gone = Script('/a/x', '/gone/python3', True, False, True, False)
    system = Script('/a/z', '/usr/bin/python3', True, True, True, False)
    scripts = [
        gone,
        replace(gone, path='/a/y'),
        system,
        replace(system, path='/a/env', is_fixed=False),
        replace(system, path='/a/own', is_own=True),
        Script('/a/shell', '/bin/sh', True, True, False, False),
    ]
    assert sentences(script_findings(scripts, str)) == [
        "ERROR: the interpreter '/gone/python3' does not exist, but is named by: /a/x, /a/y",
        "ERROR: '/usr/bin/python3' is not the Python of this environment, but runs: /a/z",
    ]


def test_scripts_are_mended_where_they_are() -> None:
    """What colcon has installed is built anew in its workspace, the rest is installed anew."""
    gone = Script('/venv/bin/colcon', '/gone/python3', True, False, True, False)
    built = replace(gone, path='/w s/install/arm/lib/arm/node', workspace=Path('/w s'))
    first, second = script_findings([gone, built], mending_command)
    assert first.mend == install_command()
    assert second.mend.startswith("cd '/w s' && rm -rf build install && source ")


def test_workspace() -> None:
    """What is not built, not sourced or older than its sources is named with its cure."""

    def found(*packages: PackageState) -> list[str]:
        return sentences(workspace_findings([Workspace(Path('/ws'), packages, True)]))

    arm = PackageState('arm', Path('/ws/src/arm'), True, True)
    leg = PackageState('leg', Path('/ws/src/leg'), False, False)
    assert found(arm) == []
    assert found(leg) == ["ERROR: the workspace '/ws' is not built"]
    assert found(replace(arm, is_known=False)) == [
        "ERROR: the workspace '/ws' is built, but not sourced in this terminal"
    ]
    assert found(arm, replace(leg, is_built=True)) == [
        "WARNING: the package 'leg' was built after this terminal was set up"
    ]
    assert found(replace(arm, changed=('launch/a.launch.py',)), leg) == [
        "WARNING: 'arm' is older than its sources: launch/a.launch.py",
        "WARNING: the package 'leg' in '/ws/src/leg' is not built",
    ]


def test_workspace_that_is_just_near() -> None:
    """A workspace that is neither sourced nor around the current folder is left alone."""
    arm = PackageState('arm', Path('/ws/src/arm'), True, False)
    leg = PackageState('leg', Path('/ws/src/leg'), False, True)
    near = Workspace(Path('/ws'), (arm,), False)
    assert sentences(workspace_findings([near])) == []
    sourced = replace(near, packages=(replace(arm, is_known=True), replace(leg, is_known=False)))
    assert sentences(workspace_findings([sourced])) == [
        "WARNING: the package 'leg' in '/ws/src/leg' is not built"
    ]


@pytest.fixture
def network() -> Network:
    """Return a network without a fault."""
    return Network(
        variables={'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'},
        interfaces=(LOOPBACK, CABLE),
        multicast={'lo': None, 'eth0': None},
        has_multicast_route=True,
        ephemeral_ports=(32768, 60999),
        shared_memory=SharedMemory(free=10**9),
    )


def test_network_without_fault(network: Network) -> None:
    """There is nothing to say about a network in which all works."""
    assert sentences(network_findings(network)) == []


@pytest.mark.parametrize(
    'variables, sentence',
    [
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'near'}, "ERROR: ROS_AUTOMATIC_DISCOVERY_RANGE is 'n"),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'}, 'WARNING: ROS_AUTOMATIC_DISCOVERY_RANGE is O'),
        ({'ROS_LOCALHOST_ONLY': '1'}, 'WARNING: ROS_LOCALHOST_ONLY is set, which is deprecated'),
        (
            {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_STATIC_PEERS': '127.0.0.1;robot'},
            "WARNING: ROS_STATIC_PEERS names 'robot', but ROS_AUTOMATIC_DISCOVERY_RANGE is "
            'LOCALHOST',
        ),
        (
            {
                'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
                'ROS_DISCOVERY_SERVER': 'localhost:11811;10.0.0.2:11811',
            },
            "WARNING: ROS_DISCOVERY_SERVER names '10.0.0.2', but ROS_AUTOMATIC_DISCOVERY_RANGE is "
            'LOCALHOST',
        ),
        (
            {'ROS_DOMAIN_ID': 'x'},
            "ERROR: ROS_DOMAIN_ID is 'x', which is not a whole number from 0 t",
        ),
        ({'ROS_DOMAIN_ID': '²'}, "ERROR: ROS_DOMAIN_ID is '²'"),
        ({'ROS_DOMAIN_ID': '233'}, "ERROR: ROS_DOMAIN_ID is '233'"),
        ({'ROS_DOMAIN_ID': '102'}, 'WARNING: the ports of domain 102 start at 32900, among the'),
        ({'FASTRTPS_DEFAULT_PROFILES_FILE': '/x'}, 'WARNING: FASTRTPS_DEFAULT_PROFILES_FILE name'),
    ],
)
def test_network_variables(network: Network, variables: dict[str, str], sentence: str) -> None:
    """Each wrong variable is named with its value."""
    changed = replace(network, variables={**network.variables, **variables})
    found = sentences(network_findings(changed))
    assert [text[: len(sentence)] for text in found] == [sentence]


@pytest.mark.parametrize(
    ('extent', 'profile', 'who'),
    [
        ('LOCALHOST', '/x/share/ros_environment/config/fastdds.xml', 'this machine only'),
        ('SUBNET', '/x/share/ros_environment/config/fastdds.xml', 'every machine in the network'),
        ('LOCALHOST', '', 'every machine in the network'),
        ('LOCALHOST', '/my.xml', 'the machines that /my.xml allows'),
        ('OFF', '', 'nobody'),
    ],
)
def test_who_reaches(network: Network, extent: str, profile: str, who: str) -> None:
    """The profile of the environment keeps LOCALHOST; another one, or none, need not."""
    variables = {
        'ROS_AUTOMATIC_DISCOVERY_RANGE': extent,
        'FASTRTPS_DEFAULT_PROFILES_FILE': profile,
    }
    assert who_reaches(replace(network, variables=variables)) == who


@pytest.mark.parametrize('domain', ['0', '42', '100', '215', '232'])
def test_safe_domains(network: Network, domain: str) -> None:
    """Domains whose ports the kernel gives to nobody are fine."""
    assert sentences(network_findings(replace(network, variables={'ROS_DOMAIN_ID': domain}))) == []


def test_interfaces(network: Network) -> None:
    """Multicast matters where nodes use it; the loopback matters always."""
    deaf = replace(network, multicast={'lo': None, 'eth0': TimeoutError()})
    assert sentences(network_findings(deaf)) == [
        "WARNING: on the interface 'eth0' (192.0.2.1), multicast does not work: packets do not "
        'arrive'
    ]
    local = replace(deaf, variables={'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'})
    assert sentences(network_findings(local)) == []
    assert sentences(network_findings(replace(network, interfaces=(CABLE,)))) == [
        'ERROR: the loopback interface is down'
    ]
    nameless = replace(network, interfaces=(LOOPBACK._replace(address=''), CABLE))
    assert sentences(network_findings(nameless)) == [
        'ERROR: the loopback interface has no address'
    ]


def test_discovery_servers() -> None:
    """One that is missing is worse if there is no other; another ID is as bad as none."""
    first, second = Server(0, 'robot', 11811), Server(1, 'lab', 7, 'TCPv4')
    answers = (Answer(first, error='no answer'), Answer(second, error='no program'))
    assert sentences(server_findings(Discovery({}, answers))) == [
        'ERROR: no discovery server answers at robot:11811: no answer',
        'ERROR: no discovery server answers at lab:7: no program',
    ]
    [finding] = server_findings(Discovery({}, (Answer(first, number=0), answers[1])))
    assert finding.severity is Severity.WARNING
    assert (
        'fastdds discovery -i 1 -t 0.0.0.0 -q 7; a firewall there has to let TCP' in finding.mend
    )
    unknown = Answer(second, error="names 'lab'", is_unresolved=True)
    [finding] = server_findings(Discovery({}, (Answer(first, number=0), unknown)))
    assert finding.severity is Severity.ERROR and 'leaves out all servers' in finding.why
    [finding] = server_findings(Discovery({}, (Answer(first, number=2),)))
    assert finding.what.startswith('the discovery server at robot:11811 has the ID 2, but')
    assert finding.mend == "export ROS_DISCOVERY_SERVER=';;robot:11811', or start it with -i 0"
    assert not sentences(server_findings(Discovery({}, (Answer(first, 0), Answer(second)))))


def test_report_of_a_mistake_in_the_servers(monkeypatch: pytest.MonkeyPatch) -> None:
    """It does not say that there is no server."""
    monkeypatch.setenv('ROS_DISCOVERY_SERVER', '127.0.0.1:abc')
    items = dict(ServersReport().report().items)
    assert items['servers'].startswith("ROS_DISCOVERY_SERVER has the entry '127.0.0.1:abc'")


@pytest.mark.parametrize(
    'servers', [';;', ' ', '127.0.0.1:abc', 'robot.invalid', 'TCPv4:[127.0.0.1]:42100']
)
def test_checks_of_nodes_without_a_server_to_ask(
    servers: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The check of the servers says why; the others are skipped, and do not repeat it."""
    monkeypatch.setenv('ROS_DISCOVERY_SERVER', servers)
    why_no_graph.cache_clear()
    try:
        assert ServersCheck().check().findings
        assert not FramesCheck().check().findings
    finally:
        why_no_graph.cache_clear()


def test_variables_of_discovery_servers(network: Network) -> None:
    """Mistakes are named; with a server multicast no longer matters."""
    wrong = {'ROS_SUPER_CLIENT': 'yes'}
    assert sentences(server_findings(Discovery(wrong, mistake="the entry 'x' is wrong"))) == [
        "ERROR: the entry 'x' is wrong",
        "WARNING: ROS_SUPER_CLIENT is 'yes', which is neither TRUE nor FALSE",
    ]
    assert not sentences(server_findings(Discovery({'ROS_SUPER_CLIENT': 'True'})))
    both = {'ROS_DISCOVERY_SERVER': 'robot', 'ROS_STATIC_PEERS': 'laptop'}
    assert sentences(server_findings(Discovery(both))) == [
        'WARNING: ROS_STATIC_PEERS has no effect, because ROS_DISCOVERY_SERVER is set'
    ]
    variables = {'ROS_DISCOVERY_SERVER': 'robot'}
    deaf = replace(network, multicast={'lo': None, 'eth0': TimeoutError()}, variables=variables)
    assert sentences(network_findings(deaf)) == []


def test_multicast_without_route(network: Network) -> None:
    """Fast DDS leaves the interface to the kernel, which needs a route where there are others."""
    lost = replace(network, has_multicast_route=False)
    [finding] = network_findings(lost)
    assert finding.what.startswith('there is no route for multicast, ')
    assert finding.mend == 'sudo ip route add 239.255.0.0/16 dev eth0'
    alone = replace(lost, interfaces=(LOOPBACK,), multicast={'lo': None})
    assert sentences(network_findings(alone)) == []


def test_multicast_that_works_nowhere(network: Network) -> None:
    """Then nodes of this machine are not found either; the cure depends on the reason."""
    error = OSError(errno.ENOBUFS, 'No buffer space available')
    deaf = replace(network, interfaces=(LOOPBACK,), multicast={'lo': error})
    [finding] = network_findings(deaf)
    assert finding.severity is Severity.ERROR
    assert finding.what == (
        'no network interface delivers multicast (lo: multicast does not work: No buffer space '
        'available)'
    )
    assert finding.mend.startswith('sudo sysctl net.ipv4.igmp_max_memberships=20, or ')


@pytest.mark.parametrize(
    ('memory', 'sentence'),
    [
        (SharedMemory(free=10**9, orphans=3, orphan_bytes=10**7), ''),
        (SharedMemory(free=5 * 10**6), 'WARNING: /dev/shm has 5 MB left'),
        (None, 'WARNING: /dev/shm is missing or cannot be written'),
        (
            SharedMemory(free=10**9, orphans=100, orphan_bytes=4 * 10**8),
            'WARNING: /dev/shm holds 400 MB of 100 processes that were killed',
        ),
    ],
)
def test_shared_memory(network: Network, memory: SharedMemory | None, sentence: str) -> None:
    """Too little room, none at all, or much that killed processes have left, is a warning."""
    found = sentences(network_findings(replace(network, shared_memory=memory)))
    assert found == ([sentence] if sentence else [])


def test_clean_up_keeps_what_is_used(tmp_path: Path) -> None:
    """The command that is named deletes the segments of killed processes, and only these."""
    for name in ('fastrtps_a1', 'fastrtps_b2', 'fastrtps_port7411'):
        (tmp_path / name).write_bytes(bytes(8192))
        (tmp_path / f'{name}_el').touch()
    with (tmp_path / 'fastrtps_a1_el').open() as used:
        fcntl.flock(used, fcntl.LOCK_EX)
        memory = read_shared_memory(tmp_path)
        assert memory is not None
        assert (memory.orphans, memory.orphan_bytes) == (1, 8192)
        subprocess.run(CLEAN_UP.replace('/dev/shm', str(tmp_path)), shell=True, check=False)
    left = sorted(path.name for path in tmp_path.iterdir() if not path.name.endswith('_el'))
    assert left == ['fastrtps_a1', 'fastrtps_port7411']


@pytest.mark.parametrize(
    'backend, libraries, sentences_expected',
    [
        ('', {'GL': 'x', 'EGL': ''}, []),
        ('', {'GL': '', 'EGL': ''}, ['WARNING: there is no OpenGL library: neither libGL nor']),
        ('egl', {'GL': 'x', 'EGL': ''}, ['WARNING: MUJOCO_GL is egl, but there is no libEGL']),
        ('glfw', {'GL': 'x', 'EGL': ''}, ['WARNING: MUJOCO_GL is glfw, which needs a display,']),
        (
            'x',
            {'GL': 'x', 'EGL': ''},
            ["WARNING: MUJOCO_GL is 'x', which is not one of egl, glfw"],
        ),
    ],
)
def test_graphics(backend: str, libraries: dict[str, str], sentences_expected: list[str]) -> None:
    """Missing libraries, and a choice that cannot work here, are warnings."""
    found = sentences(
        graphics_findings(Graphics({'MUJOCO_GL': backend}, libraries, ('50_mesa',), {}))
    )
    assert [text[: len(start)] for text, start in zip(found, sentences_expected)] == (
        sentences_expected
    )
    assert len(found) == len(sentences_expected)


@pytest.mark.parametrize(('backend', 'count'), [('', 1), ('EGL', 1), ('osmesa', 0)])
def test_graphics_without_driver(backend: str, count: int) -> None:
    """The library alone draws nothing; that matters where it is used."""
    libraries = {'EGL': 'x', 'OSMesa': 'x'}
    found = sentences(graphics_findings(Graphics({'MUJOCO_GL': backend}, libraries, (), {})))
    assert found == ['WARNING: libEGL is installed, but no driver for it'] * count


def test_graphics_card_of_others() -> None:
    """A card that this user may not use is named."""
    facts = Graphics({}, {'GL': 'x'}, (), {'/dev/dri/renderD128': False, '/dev/nvidia0': True})
    assert sentences(graphics_findings(facts)) == [
        "WARNING: this user has no permission to use the graphics card '/dev/dri/renderD128'"
    ]


def endpoint(node: str, *, is_publisher: bool, qos: str, type_name: str = 'String') -> Endpoint:
    """Return a publisher or subscription of one topic."""
    return Endpoint('/image', node, type_name, is_publisher, qos)


def test_pairs_name_both_nodes() -> None:
    """Each pair is compared in the right order; only those that do not match are named."""
    endpoints = [
        endpoint('/viewer', is_publisher=False, qos='reliable'),
        endpoint('/camera', is_publisher=True, qos='best effort'),
        endpoint('/recorder', is_publisher=False, qos='best effort'),
        endpoint('/other', is_publisher=False, qos='best effort', type_name='Int32'),
    ]

    def why_not(offered: str, requested: str) -> str:
        return 'unreliable' if (offered, requested) == ('best effort', 'reliable') else ''

    assert sentences(pair_findings(endpoints, why_not)) == [
        "ERROR: on '/image', the QoS that '/camera' offers does not satisfy '/viewer' "
        '(unreliable)',
        "ERROR: on '/image', '/camera' publishes String, but '/other' subscribes to Int32",
    ]


def test_a_node_that_subscribes_twice() -> None:
    """A node is reached if one of its subscriptions fits: that is what it has two for."""
    endpoints = [
        endpoint('/stopper', is_publisher=True, qos='volatile'),
        endpoint('/robot', is_publisher=False, qos='transient local'),
        endpoint('/robot', is_publisher=False, qos='volatile'),
        endpoint('/late', is_publisher=False, qos='transient local'),
    ]

    def why_not(offered: str, requested: str) -> str:
        return 'nothing kept' if (offered, requested) == ('volatile', 'transient local') else ''

    assert sentences(pair_findings(endpoints, why_not)) == [
        "ERROR: on '/image', the QoS that '/stopper' offers does not satisfy '/late' "
        '(nothing kept)'
    ]


def test_what_nodes_complain_of() -> None:
    """What a node says that is not all right is shown, until it is all right again."""
    listener = DiagnosticsListener(None)

    def say(level: int, message: str) -> None:
        status = SimpleNamespace(name='simulator: loop', level=bytes([level]), message=message)
        listener.take(SimpleNamespace(status=[status]))

    say(1, 'slow')
    assert sentences(diagnostics_findings(listener.complaints)) == [
        "WARNING: 'simulator: loop' reports: slow"
    ]
    say(2, 'broken')
    assert sentences(diagnostics_findings(listener.complaints)) == [
        "ERROR: 'simulator: loop' reports: broken"
    ]
    say(0, 'runs')
    assert sentences(diagnostics_findings(listener.complaints)) == []


def test_nodes_of_other_machines() -> None:
    """They are a warning in the domain that everybody has; another one was chosen on purpose."""
    graph = Graph(elsewhere=('/nao', '/wolfgang'))
    [sentence] = sentences(NeighboursCheck().findings(graph))
    assert sentence.startswith('WARNING: nodes of other machines are in domain 0, which ')
    assert sentence.endswith(': /nao, /wolfgang')
    assert sentences(NeighboursCheck().findings(replace(graph, domain_id=42))) == []
    assert sentences(NeighboursCheck().findings(Graph())) == []


def test_names_of_nodes() -> None:
    """A name that several nodes have is a warning with their number."""
    found = sentences(name_findings(['/a', '/b', '/a', '/a']))
    assert found == ["WARNING: 3 nodes have the name '/a'"]


@pytest.mark.parametrize(
    ('nodes', 'topic', 'is_publisher', 'is_found'),
    [
        (('/robot1/arm', '/robot2/arm'), '/joint_commands', True, True),
        (('/robot1/arm',), '/joint_commands', True, False),
        (('/robot1/arm', '/robot2/leg'), '/joint_commands', True, False),
        (('/arm', '/robot2/arm'), '/joint_commands', True, False),
        (('/robot1/arm', '/robot2/arm'), '/map', False, False),
        (('/robot1/arm', '/robot2/arm'), '/tf', True, False),
        (('/fleet/robot1/arm', '/fleet/robot2/arm'), '/fleet/robot1/joint_commands', True, False),
    ],
)
def test_namespaces_without_effect(
    nodes: tuple[str, ...], topic: str, is_publisher: bool, is_found: bool
) -> None:
    """Robots that publish on one absolute topic are named; what robots share is no finding."""
    found = list(
        namespace_findings(Endpoint(topic, node, 'T', is_publisher, None) for node in nodes)
    )
    assert bool(found) is is_found
    if found:
        assert sentences(found) == [
            "WARNING: the namespaces robot1 and robot2 have no effect on '/joint_commands' of "
            "'arm'"
        ]
        assert "'joint_commands' in the node, which becomes '/robot1/joint_commands'" in (
            found[0].mend
        )


@pytest.mark.parametrize(
    'edges, expected',
    [
        (['odom base', 'base head'], []),
        (['odom base', 'map odom', 'x y'], ["WARNING: on '/tf' there are 2 frame trees"]),
        (['a c', 'b c', 'b a'], ["ERROR: on '/tf', the frame 'c' has 2 parents: a, b"]),
        (['a c', 'b c'], ["ERROR: on '/tf', the frame 'c' has 2 parents: a, b"]),
        (['a b', 'b a'], ["ERROR: on '/tf', the frames form a loop: a, b"]),
        (
            ['map odom', 'a b', 'b a', 'b c'],
            ["ERROR: on '/tf', the frames form a loop: a, b, c"],
        ),
        ([], []),
    ],
)
def test_frames(edges: list[str], expected: list[str]) -> None:
    """Two trees, two parents and circles are named."""
    transforms = [Transform('/tf', *edge.split()) for edge in edges]
    found = sentences(frame_findings(transforms))
    assert [text[: len(start)] for text, start in zip(found, expected)] == expected
    assert len(found) == len(expected)


def test_trees_are_joined_by_a_command() -> None:
    """The command publishes the transform that is missing; tf2 finds it on the static topic."""
    [finding] = frame_findings([Transform('/tf', 'base', 'x'), Transform('/tf', 'odom', 'y')])
    command = shlex.split(finding.mend.splitlines()[-1])
    assert command[:5] == ['ros2', 'topic', 'pub', '-r', '1']
    assert command[-3:-1] == ['/tf_static', 'tf2_msgs/msg/TFMessage']
    [transform] = yaml.safe_load(command[-1])['transforms']
    assert (transform['header']['frame_id'], transform['child_frame_id']) == ('odom', 'base')


def test_trees_without_a_clock() -> None:
    """Where nodes wait for /clock, nothing is to be published by hand."""
    edges = [Transform('/tf', 'base', 'x'), Transform('/tf', 'odom', 'y')]
    [finding] = frame_findings(edges, waits_for_clock=True)
    assert finding.mend.startswith('start a publisher of /clock first')


def test_nodes_without_a_clock() -> None:
    """The nodes whose time stands still are named in one finding."""
    assert sentences(clock_findings(())) == []
    assert sentences(clock_findings(['/a', '/b'])) == [
        'ERROR: use_sim_time is true, but there is no publisher on /clock: /a, /b'
    ]


def test_frames_of_two_robots_are_two_trees() -> None:
    """Topics of different namespaces have nothing to do with each other."""
    transforms = [Transform('/r1/tf', 'odom', 'base'), Transform('/r2/tf', 'odom', 'base')]
    assert sentences(frame_findings(transforms)) == []
