# SPDX-License-Identifier: Apache-2.0
"""What the tests of both publishers share: programs, and a node that talks to them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math
from pathlib import Path
import signal
import subprocess
import sys
import time
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState

TIMEOUT_S = 100.0
REPEAT_S = 2.0
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@dataclass
class Program:
    """A running program, and the file with all that it writes."""

    process: subprocess.Popen[str]
    file: Path

    @property
    def output(self) -> str:
        """Return what it has written so far."""
        return self.file.read_text()

    def end(self, number: int = signal.SIGINT) -> int:
        """Send a signal and return the exit status."""
        self.process.send_signal(number)
        return self.process.wait(TIMEOUT_S)


class Programs:
    """Starts modules, and ends them after the `with`."""

    def __init__(self, environment: dict[str, str], folder: Path) -> None:
        """Start nothing yet."""
        self._environment = environment
        self._folder = folder
        self._started: list[Program] = []

    def start(self, module: str, *words: str, **parameters: str) -> Program:
        """Start a module with arguments and, as texts in YAML, parameters."""
        if parameters:
            words = *words, '--ros-args'
            for name, value in parameters.items():
                words = *words, '-p', f'{name}:={value}'
        file = self._folder / f'output_{len(self._started)}'
        with file.open('w') as stream:
            process = subprocess.Popen(
                [sys.executable, '-m', module, *words],
                env=self._environment,
                stdout=stream,
                stderr=subprocess.STDOUT,
            )
        self._started.append(Program(process, file))
        return self._started[-1]

    def __enter__(self) -> Programs:
        """Begin."""
        return self

    def __exit__(self, *error: object) -> None:
        """End what still runs."""
        for program in self._started:
            if program.process.poll() is None:
                program.process.kill()
                program.process.wait()


class Probe:
    """A node that listens, sends and waits."""

    def __init__(self, domain: int) -> None:
        """Make the node in a context of its own."""
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=domain)
        self.node = rclpy.create_node('probe', context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)

    def listen(self, kind: Any, topic: str, qos: QoSProfile | int = 100) -> list[Any]:
        """Return a list that grows with the messages of a topic."""
        heard: list[Any] = []
        self.node.create_subscription(kind, topic, heard.append, qos)
        return heard

    def sender(self, kind: Any, topic: str, qos: QoSProfile | int = 100) -> Any:
        """Return a publisher that somebody hears."""
        publisher = self.node.create_publisher(kind, topic, qos)
        self.until(publisher.get_subscription_count, f'nobody subscribed to {topic}')
        return publisher

    def state(self, stamp_s: float | None = None, **positions: float) -> JointState:
        """Return a joint state; it is from now, unless a time is given."""
        message = JointState(name=list(positions), position=list(positions.values()))
        now = self.node.get_clock().now().to_msg()
        if stamp_s is not None:
            now.sec, now.nanosec = int(stamp_s), round(stamp_s % 1 * 1e9)
        message.header.stamp = now
        return message

    def set_parameters(self, node: str, **values: Any) -> list[Any]:
        """Set parameters of a node; return the results."""
        client = AsyncParameterClient(self.node, node)
        self.until(client.services_are_ready, f'{node} has no parameters')
        parameters = [Parameter(name, value=value) for name, value in values.items()]
        answer = self.answer_to(
            lambda: client.set_parameters(parameters), f'{node} did not answer'
        )
        return list(answer.results)

    def answer_to(self, ask: Callable[[], Any], message: str) -> Any:
        """Ask, again after two seconds without an answer; return the answer, or fail."""
        futures: list[Any] = []
        asked_s = -math.inf

        def is_answered() -> bool:
            nonlocal asked_s
            if time.monotonic() - asked_s > REPEAT_S:
                futures.append(ask())
                asked_s = time.monotonic()
            return any(future.done() for future in futures)

        self.until(is_answered, message)
        return next(future.result() for future in futures if future.done())

    def until(self, is_so: Callable[[], Any], message: str) -> None:
        """Work until something is so, or fail with the message."""
        end_s = time.monotonic() + TIMEOUT_S
        while not is_so():
            assert time.monotonic() < end_s, message
            self._executor.spin_once(timeout_sec=0.05)

    def for_some_time(self, seconds: float) -> None:
        """Work for a while: to see that something does not come."""
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            self._executor.spin_once(timeout_sec=0.05)

    def send_until(self, send: Callable[[], None], is_so: Callable[[], Any], message: str) -> None:
        """Send again and again until something is so."""

        def sent() -> bool:
            send()
            self.for_some_time(0.05)
            return bool(is_so())

        self.until(sent, message)

    def __enter__(self) -> Probe:
        """Begin."""
        return self

    def __exit__(self, *error: object) -> None:
        """Destroy the node."""
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)
