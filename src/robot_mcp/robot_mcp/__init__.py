# SPDX-License-Identifier: Apache-2.0
"""Model Context Protocol (MCP) server through which assistants observe and command the robot."""
