# Messages and run-time parameters.
add_message_files(DIRECTORY msg FILES LightFieldDepthStats.msg)
generate_messages(DEPENDENCIES std_msgs)
generate_dynamic_reconfigure_options(config/LightFieldDepth.cfg)
