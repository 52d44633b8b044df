# SPDX-License-Identifier: Apache-2.0
"""Topics of the simulator: clock, ground truth, contacts, wrenches, scene and world frame."""
