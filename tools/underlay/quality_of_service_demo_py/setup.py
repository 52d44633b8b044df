# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'quality_of_service_demo_py'
DEMOS = (
    'deadline',
    'incompatible_qos',
    'lifespan',
    'liveliness',
    'message_lost_listener',
    'message_lost_talker',
)

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Demos of the quality of service: each shows one policy.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [f'{demo} = quality_of_service_demo_py.{demo}:main' for demo in DEMOS],
    },
)
