# SPDX-License-Identifier: Apache-2.0
"""The parameters of every node that runs robots."""

from __future__ import annotations

from dataclasses import dataclass
import re

from humanoid_common.parameters import parameter, ParameterError
from humanoid_control.controllers.modes import POLICY
from humanoid_control.walking.parameters import WalkParameters

WALKING = 'walking'
MODES = (WALKING, 'follow', 'hold', POLICY)
_NAMESPACE = re.compile(r'[A-Za-z][A-Za-z0-9_]{0,59}')


@dataclass(frozen=True)
class HostParameters:
    """The robots, their model, mode and walk, and the control and publishing rates."""

    robots: tuple[str, ...] = parameter(
        ('',),
        'The namespaces of the robots; an empty string is one robot in the namespace of the node.',
        read_only=True,
    )
    scale: float = parameter(
        1.0, 'Scale of the robots, as in the model.', at_least=0.5, at_most=1.3, read_only=True
    )
    prefix: str = parameter(
        '', 'Prefix of the names of all links and joints, as in the model.', read_only=True
    )
    hands: bool = parameter(
        False, 'Whether the arms have wrists and grippers, as in the model.', read_only=True
    )
    walk: WalkParameters = WalkParameters()
    control_rate_hz: float = parameter(
        100.0,
        'Rate of the control loop, in the time of the robot.',
        at_least=50.0,
        at_most=500.0,
        read_only=True,
    )
    mode: str = parameter(
        WALKING,
        'What the robots do, and which joints controllers may claim: those above the legs with '
        'walking, all with follow, none with hold, those that it does not move with policy.',
        choices=MODES,
    )
    policy: str = parameter(
        'stand',
        'What the mode policy runs: an installed policy, or the path of a file that ends with '
        '.yaml. Setting it loads the file again.',
    )
    joint_states_rate_hz: float = parameter(
        50.0, 'Rate of joint_states; 0 turns it off.', at_least=0.0, at_most=500.0
    )
    imu_rate_hz: float = parameter(
        100.0, 'Rate of imu/data; 0 turns it off.', at_least=0.0, at_most=500.0
    )
    odometry_rate_hz: float = parameter(
        50.0, 'Rate of odom and tf; 0 turns them off.', at_least=0.0, at_most=500.0
    )
    debug_rate_hz: float = parameter(
        10.0,
        'Rate of footsteps, walking/dcm and walking/zmp; 0 turns them off.',
        at_least=0.0,
        at_most=500.0,
    )
    heartbeat_timeout_s: float = parameter(
        1.0,
        'How long the console in control may be silent before the robots hold still.',
        at_least=0.2,
        at_most=10.0,
    )

    def __post_init__(self) -> None:
        """Check the names of the robots."""
        for name in self.robots:
            if not (name == '' and len(self.robots) == 1) and not _NAMESPACE.fullmatch(name):
                raise ParameterError(
                    f"Parameter 'robots' contains '{name}', which is not a valid namespace. Give "
                    'names of up to 60 letters, digits and underscores that start with a letter; '
                    'a single robot may have an empty one.',
                    'robots',
                )
            if self.robots.count(name) > 1:
                raise ParameterError(
                    f"Parameter 'robots' names '{name}' more than once. Name every robot once.",
                    'robots',
                )
