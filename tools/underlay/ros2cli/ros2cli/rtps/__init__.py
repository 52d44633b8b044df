# SPDX-License-Identifier: Apache-2.0
"""
The part of the RTPS protocol that tells who is there and what they publish and subscribe to.

A participant of DDS answers at once whoever greets it, and says how many endpoints it has. So
the graph is read by asking, one participant after the other: it takes milliseconds, it is known
to be complete, and neither rclpy nor a daemon is needed. After the specification "The Real-time
Publish-Subscribe Protocol DDS Interoperability Wire Protocol", version 2.5 (OMG
formal/22-04-01); numbers in brackets are its sections.
"""
