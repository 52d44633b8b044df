# SPDX-License-Identifier: Apache-2.0
"""The policies of the robots of a node: loaded when a parameter asks for them, or refused."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Protocol

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.paths import expanded_path
from humanoid_control.controllers.modes import POLICY
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.policy.controller import PolicyController
from humanoid_control.policy.policy import Policy
from humanoid_control.policy.policy_file import PolicyError
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class PolicyHost(Protocol):
    """A robot that can run a policy."""

    @property
    def policy(self) -> PolicyController:
        """Return the controller of its mode `policy`."""

    def use_policy(self, policy: Policy) -> None:
        """
        Let the mode `policy` run a policy from now on.

        Parameters
        ----------
        policy
            The policy, loaded for this robot.

        """


class Policies:
    """
    Loads policies for the robots of a node when the parameter `policy` or the mode is set.

    A change to a policy that cannot be run is refused with the reason. At the start, the reason is
    logged, and robots in the mode `policy` hold their pose.

    Parameters
    ----------
    node
        The node, whose parameters name the policy.
    robots
        The robots, by name.
    parameters : HostParameters
        Mode, policy and control rate.

    """

    def __init__(
        self, node: Node, robots: Mapping[str, PolicyHost], parameters: HostParameters
    ) -> None:
        self._robots, self._rate_hz = dict(robots), parameters.control_rate_hz
        self._name = parameters.policy
        self._loaded: dict[str, Policy] = {}
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._apply)
        if parameters.mode == POLICY:
            try:
                self._load(self._name)
            except UserError as error:
                node.get_logger().error(f'{error} The robot holds its pose.')
            self._apply([])

    def _check(self, changes: Sequence[Parameter]) -> SetParametersResult:
        """Load the policy that changes ask for; refuse them if it cannot be run."""
        given = {change.name: change.value for change in changes}
        self._loaded.clear()
        if 'policy' in given or given.get('mode') == POLICY:
            try:
                self._load(str(given.get('policy', self._name)))
            except UserError as error:
                return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _load(self, name: str) -> None:
        """Load a policy for each robot."""
        path = policy_path(name)
        for robot, host in self._robots.items():
            policy = Policy.load(path, host.policy.robot)
            if policy.file.rate_hz > self._rate_hz:
                raise policy.file.error(
                    f'It decides at {policy.file.rate_hz:g} Hz, but the control loop runs at '
                    f"{self._rate_hz:g} Hz. Start with a higher 'control_rate_hz'."
                )
            self._loaded[robot] = policy

    def _apply(self, changes: Sequence[Parameter]) -> None:
        """Let the robots run what was loaded."""
        for change in changes:
            if change.name == 'policy':
                self._name = str(change.value)
        for robot, policy in self._loaded.items():
            self._robots[robot].use_policy(policy)
        self._loaded.clear()


def policy_path(name: str) -> Path:
    """
    Find a policy file.

    Parameters
    ----------
    name
        An installed policy, or the path of a file that ends with .yaml.

    Raises
    ------
    PolicyError
        No such policy is installed.
    UserError
        The path begins with a home folder that does not exist.

    """
    if name.endswith('.yaml'):
        return expanded_path(name)
    folder = Path(get_package_share_directory('humanoid_control')) / 'policies'
    installed = sorted(path.stem for path in folder.glob('*.yaml'))
    if name not in installed:
        sentences = (
            f"No policy '{name}' is installed.",
            did_you_mean(name, installed),
            f"Set 'policy' to {' or '.join(installed)}, or to the path of a file that ends with "
            '.yaml.',
        )
        raise PolicyError(' '.join(filter(None, sentences)))
    return folder / f'{name}.yaml'
