# SPDX-License-Identifier: Apache-2.0
"""
The discovery part of the RTPS protocol: participants, endpoints and nodes.

A DDS participant answers a greeting at once, and reports how many endpoints it has. So the graph
is read by querying one participant after the other: it takes milliseconds, it is known to be
complete, and neither rclpy nor a daemon is needed. After the specification "The Real-time
Publish-Subscribe Protocol DDS Interoperability Wire Protocol", version 2.5 (OMG
formal/22-04-01); numbers in brackets are its sections.
"""
