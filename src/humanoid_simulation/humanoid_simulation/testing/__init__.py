# SPDX-License-Identifier: Apache-2.0
"""
Test utilities for simulated robots.

- `humanoid_simulation.testing.simulators`: a headless simulator for the duration of a test, whose
  robot is driven, pushed and watched over its topics
- `humanoid_simulation.testing.camera_studio`: objects in front of a camera, and their images
"""
