# SPDX-License-Identifier: Apache-2.0
"""Topics of a robot: rates, QoS compatibility and message contents."""
