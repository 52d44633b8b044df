# SPDX-License-Identifier: Apache-2.0
"""Let assistants that speak the Model Context Protocol look at the robot and drive it."""
