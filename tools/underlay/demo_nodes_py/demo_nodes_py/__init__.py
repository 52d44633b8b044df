# SPDX-License-Identifier: Apache-2.0
"""Small nodes that show topics, services, parameters, events and logging."""
