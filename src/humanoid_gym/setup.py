# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_gym."""

from __future__ import annotations

from setuptools import find_packages, setup

package_name = 'humanoid_gym'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Gymnasium environments of the simulated humanoid: walk, stand, reach',
    license='Apache-2.0',
    scripts=['scripts/train_balance'],
)
