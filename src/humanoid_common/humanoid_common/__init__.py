# SPDX-License-Identifier: Apache-2.0
"""
What every node of the humanoid shares.

- `humanoid_common.parameters`: parameters as a checked, frozen dataclass (no ROS needed)
- `humanoid_common.node_parameters`: the same parameters, declared on a node
- `humanoid_common.running`: the body of every `main`
- `humanoid_common.periodic`: a timer for what moves in the world
- `humanoid_common.qos`: quality of service by name
- `humanoid_common.testing`: what the tests of several packages share
"""
