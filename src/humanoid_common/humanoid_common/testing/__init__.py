# SPDX-License-Identifier: Apache-2.0
"""
Helpers for the tests of several packages.

- `humanoid_common.testing.waiting`: wait for a condition instead of sleeping
- `humanoid_common.testing.processes`: run a program, read its output, signal it
- `humanoid_common.testing.launching`: run launch files, or inspect them without running them
- `humanoid_common.testing.ros`: nodes in this process, in a domain of their own
"""
