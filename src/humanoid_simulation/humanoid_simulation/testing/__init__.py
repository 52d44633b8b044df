# SPDX-License-Identifier: Apache-2.0
"""
What system tests of a simulated robot need.

- `humanoid_simulation.testing.simulated_robot`: drive, push and watch a robot over its topics
- `humanoid_simulation.testing.simulators`: a simulator for the length of a test, without a screen
"""
