# SPDX-License-Identifier: Apache-2.0
"""
The mode `policy`: a network that was trained elsewhere moves joints of the robot.

- `policy_file`: what the YAML file beside the network says, and its mistakes
- `observation`: what the network observes, in its order and with its history
- `network`: the ONNX file, run by onnxruntime
- `policy`: from an observation of the robot to targets of joints
- `controller`: the mode, with the fall watch and what happens on a fault
"""

from humanoid_control.policy.controller import PolicyController
from humanoid_control.policy.network import Network, OnnxNetwork
from humanoid_control.policy.policy import Policy, PolicyRobot
from humanoid_control.policy.policy_file import PolicyError, PolicyFile, read_policy_file

__all__ = [
    'Network',
    'OnnxNetwork',
    'Policy',
    'PolicyController',
    'PolicyError',
    'PolicyFile',
    'PolicyRobot',
    'read_policy_file',
]
