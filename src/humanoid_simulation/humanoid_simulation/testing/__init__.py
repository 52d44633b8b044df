# SPDX-License-Identifier: Apache-2.0
"""
What tests of the simulator share.

- `humanoid_simulation.testing.simulated_robot`: drive, push and watch a robot over its topics
- `humanoid_simulation.testing.simulators`: a simulator for the length of a test, without a screen
- `humanoid_simulation.testing.camera_world`: things in front of a camera
"""
