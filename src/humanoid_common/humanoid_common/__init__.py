# SPDX-License-Identifier: Apache-2.0
"""
Shared code of all nodes of the humanoid.

- `humanoid_common.parameters`: parameters as a checked, frozen dataclass (no ROS needed)
- `humanoid_common.node_parameters`: the same parameters, declared on a node
- `humanoid_common.running`: the body of every `main`
- `humanoid_common.periodic`: a periodic timer by the clock of the node
- `humanoid_common.qos`: QoS profiles by name
- `humanoid_common.testing`: helpers for the tests of several packages
"""
