# SPDX-License-Identifier: Apache-2.0
"""List the transports of images: `ros2 run image_transport list_transports`."""

from __future__ import annotations

import argparse
import sys

from rclpy.utilities import remove_ros_args

__all__ = ['main']


def main() -> int:
    """Print the transports; return the exit status."""
    parser = argparse.ArgumentParser(
        prog='list_transports', description='List the transports of images.'
    )
    parser.parse_args(remove_ros_args(sys.argv)[1:])
    from image_transport.transports import TRANSPORTS

    print('Declared transports:')
    for name in TRANSPORTS:
        print(f'image_transport/{name}')
    print('\nDetails:')
    for name, transport in TRANSPORTS.items():
        print('----------')
        print(f'"image_transport/{name}"')
        print(' - Provided by package: image_transport')
        print(f' - Publisher: {transport.publisher}')
        print(f' - Subscriber: {transport.subscriber}')
    return 0


if __name__ == '__main__':
    sys.exit(main())
