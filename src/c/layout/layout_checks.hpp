// Written by isostep_interface: the members of each C struct.
// SPDX-License-Identifier: MIT
#pragma once

#define ISO_C_CHECKS(X) \
  X(vec3, false, O(x), O(y), O(z)) \
  X(unit_vec3, false, O(x), O(y), O(z)) \
  X(quat, false, O(x), O(y), O(z), O(w)) \
  X(pose, false, O(position), O(orientation)) \
  X(mat3, false, O(rows)) \
  X(aabb, false, O(low), O(high)) \
  X(material, false, O(friction), O(restitution), O(rolling_resistance), O(spin_resistance), O(surface_velocity), \
    O(static_friction), O(anisotropy), O(kind), O(reserved)) \
  X(primitive, false, O(type), O(blob), O(half), O(radius), O(normal), O(offset)) \
  X(part_traits, false, O(flags), O(filter), O(material)) \
  X(child, false, O(primitive), O(pose), O(traits), O(user_data)) \
  X(joint_range, false, O(lower), O(upper)) \
  X(joint_motor, false, O(speed), O(max_force)) \
  X(joint_spring, false, O(frequency), O(damping), O(target)) \
  X(joint_servo, false, O(frequency), O(damping), O(target), O(max_force), O(mass)) \
  X(drive, false, O(joint), O(axis), O(limited), O(motor), O(lower), O(upper), O(motor_speed), O(spring_target), \
    O(spring_frequency), O(spring_damping), O(max_force), O(spring_mass), O(limit_frequency), O(limit_damping)) \
  X(ragdoll_bone, false, O(parent), O(shape), O(pose), O(mass), O(joint), O(hinge), O(swing_x), O(swing_y), O(lower), \
    O(upper)) \
  X(ray_hit, false, O(body), O(child), O(triangle), O(point), O(normal), O(fraction), O(material), O(inside)) \
  X(shape_hit, false, O(body), O(child), O(triangle), O(point), O(normal), O(fraction), O(material), O(inside)) \
  X(closest_body, false, O(body), O(child), O(point), O(normal), O(distance)) \
  X(contact_begin, false, O(a), O(b), O(child_a), O(child_b), O(impulse), O(normal)) \
  X(broke, false, O(body), O(impulse), O(point), O(direction)) \
  X(joint_broke, false, O(joint), O(a), O(b), O(user_data), O(force), O(torque)) \
  X(contact_hit, false, O(a), O(b), O(child_a), O(child_b), O(point), O(normal), O(speed)) \
  X(contact_point, false, O(a), O(b), O(child_a), O(child_b), O(triangle_a), O(triangle_b), O(point), O(normal), \
    O(separation), O(impulse)) \
  X(settings, true, O(hz), O(substeps), O(gravity), O(allow_sleep), O(solver), O(id_space), O(most_pairs), \
    O(projection), O(restitution_threshold)) \
  X(body_definition, true, O(type), O(shape), O(position), O(orientation), O(velocity), O(angular_velocity), \
    O(density), O(mass), O(inertia), O(material), O(filter), O(user_data), O(gravity_scale), O(linear_damping), \
    O(angular_damping), O(locks), O(sensor), O(allow_sleep), O(collide), O(bullet), O(report_contacts)) \
  X(body_mass, true, O(density), O(mass), O(inertia)) \
  X(body_state, true, O(pose), O(centre), O(velocity), O(angular_velocity), O(user_data), O(type), O(awake), \
    O(enabled)) \
  X(body_properties, true, O(type), O(flags), O(filter), O(user_data), O(mass), O(local_centre), O(material), \
    O(gravity_scale), O(linear_damping), O(angular_damping)) \
  X(sphere, true, O(radius)) \
  X(box, true, O(half_extents)) \
  X(capsule, true, O(radius), O(half_height)) \
  X(half_space, true, O(normal), O(offset)) \
  X(cylinder, true, O(radius), O(half_height)) \
  X(cone, true, O(radius), O(half_height)) \
  X(hull, true, O(radius)) \
  X(joint_properties, true, O(type), O(flags), O(body_a), O(body_b), O(generation_a), O(generation_b), O(user_data), \
    O(frame_a), O(frame_b), O(lower), O(upper), O(cone), O(motor_speed), O(max_force), O(spring_target), \
    O(spring_frequency), O(spring_damping)) \
  X(ball, true, O(a), O(b), O(frame), O(has_cone), O(cone), O(has_twist), O(twist), O(collide)) \
  X(constant_velocity, true, O(a), O(b), O(frame), O(has_cone), O(cone), O(has_twist), O(twist), O(collide)) \
  X(fixed, true, O(a), O(b), O(frame), O(collide)) \
  X(universal, true, O(a), O(b), O(frame), O(collide)) \
  X(angular, true, O(a), O(b), O(frame), O(collide)) \
  X(hinge, true, O(a), O(b), O(frame), O(has_limit), O(limit), O(has_motor), O(motor), O(has_spring), O(spring), \
    O(collide)) \
  X(slider, true, O(a), O(b), O(frame), O(has_limit), O(limit), O(has_motor), O(motor), O(has_spring), O(spring), \
    O(collide)) \
  X(cylindrical, true, O(a), O(b), O(frame), O(has_limit), O(limit), O(has_motor), O(motor), O(has_spring), O(spring), \
    O(collide)) \
  X(planar, true, O(a), O(b), O(frame), O(has_limit), O(limit), O(has_motor), O(motor), O(has_spring), O(spring), \
    O(collide)) \
  X(rod, true, O(a), O(b), O(anchor_a), O(anchor_b), O(length), O(has_spring), O(spring), O(collide)) \
  X(rope, true, O(a), O(b), O(anchor_a), O(anchor_b), O(length), O(has_spring), O(spring), O(collide)) \
  X(wheel_joint, true, O(a), O(b), O(frame), O(suspension), O(travel), O(has_steer), O(steer), O(has_drive), O(drive), \
    O(collide)) \
  X(motor_joint, true, O(a), O(b), O(frame_a), O(frame_b), O(place), O(turn), O(collide)) \
  X(six_axis, true, O(a), O(b), O(frame), O(locks), O(drives), O(drive_count), O(collide)) \
  X(ragdoll_settings, true, O(friction), O(pose), O(limit_frequency), O(limit_damping), O(filter), O(material)) \
  X(ray_cast, true, O(origin), O(translation), O(filter)) \
  X(shape_cast, true, O(shape), O(primitive), O(pose), O(translation), O(filter)) \
  X(overlap_query, true, O(shape), O(primitive), O(pose), O(filter)) \
  X(point_query, true, O(point), O(max_distance), O(filter)) \
  X(box_query, true, O(box), O(filter)) \
  X(force_zone, true, O(shape), O(pose), O(half), O(acceleration), O(wind), O(mask), O(priority), O(replaces)) \
  X(attractor, true, O(body), O(point), O(strength), O(least_distance), O(range), O(mask)) \
  X(body_spring, true, O(a), O(b), O(anchor_a), O(anchor_b), O(rest_length), O(stiffness), O(damping), O(only_pulls)) \
  X(thruster, true, O(body), O(point), O(force)) \
  X(buoyancy, true, O(body), O(point), O(max_depth), O(volume), O(surface_height), O(density)) \
  X(explosion, true, O(centre), O(begin), O(implosion_force), O(implosion_least), O(implosion_most), \
    O(implosion_duration), O(wave_force), O(wave_speed), O(wave_width), O(wave_ramp), O(wave_duration), \
    O(chimney_force), O(chimney_radius), O(chimney_height), O(chimney_duration), O(is_shielded), O(mask)) \
  X(water, true, O(surface_height), O(density), O(middle), O(half), O(current), O(linear_drag), O(quadratic_drag), \
    O(angular_drag), O(wave_height), O(wave_length), O(wave_period), O(wave_direction), O(mask), O(priority), \
    O(replaces)) \
  X(drag, true, O(body), O(linear), O(quadratic), O(angular)) \
  X(aero_surface, true, O(body), O(point), O(orientation), O(tensor), O(low), O(high), O(control), O(is_quadratic), \
    O(is_under_water)) \
  X(damping_zone, true, O(shape), O(pose), O(half), O(linear), O(angular), O(mask), O(priority), O(replaces)) \
  X(material_pair, true, O(kind_a), O(kind_b), O(friction), O(static_friction), O(restitution), O(rolling_resistance), \
    O(spin_resistance)) \
  X(breakable, true, O(body), O(break_impulse), O(pattern), O(most_pieces), O(depth), O(grain), O(seed), \
    O(small_mass), O(lifetime), O(expires), O(owns_shape)) \
  X(character, true, O(body), O(step_height), O(least_up), O(skin), O(mass), O(push_force), O(air_acceleration), \
    O(gravity_scale), O(mask)) \
  X(vehicle, true, O(body), O(engine_torque), O(engine_speed), O(gears), O(final_drive), O(engine_inertia), \
    O(clutch_torque), O(differential_lock), O(brake_torque), O(handbrake_torque), O(ackermann), O(track_steer)) \
  X(wheel, true, O(body), O(hard_point), O(suspension), O(axle_direction), O(free_length), O(travel), O(stiffness), \
    O(damping), O(radius), O(inertia), O(grip_along), O(grip_across), O(peak_slip), O(peak_grip), O(slide_slip), \
    O(slide_grip), O(steer_angle), O(drive_share), O(brake_share), O(handbrake_share), O(axle), O(anti_roll), \
    O(track)) \
  X(surface_velocity, true, O(body), O(linear), O(angular), O(part)) \
  X(ghost, true, O(a), O(b)) \
  X(one_way, true, O(body), O(axis), O(least_cosine)) \
  X(hit_report, true, O(body), O(speed)) \
  X(contact_report, true, O(body)) \
  X(joint_load, true, O(joint), O(break_force), O(break_torque)) \
  X(coupling, true, O(joint_a), O(joint_b), O(joint_c), O(ratio_a), O(ratio_b), O(ratio_c), O(lower), O(upper)) \
  X(axis_drive, true, O(joint), O(axis), O(limited), O(motor), O(lower), O(upper), O(motor_speed), O(spring_target), \
    O(spring_frequency), O(spring_damping), O(max_force), O(spring_mass), O(limit_frequency), O(limit_damping)) \
  X(kind_ghost, true, O(kind_a), O(kind_b)) \
  X(kind_response, true, O(kind_a), O(kind_b), O(inverse_mass_scale_a), O(inverse_mass_scale_b), \
    O(inverse_inertia_scale_a), O(inverse_inertia_scale_b), O(max_force)) \
  X(sensor_mount, true, O(sensor), O(on), O(frame)) \
  X(breakable_input, true, O(impulse), O(point), O(direction)) \
  X(character_input, true, O(move), O(jump)) \
  X(vehicle_input, true, O(throttle), O(clutch), O(brake), O(handbrake), O(steer), O(gear)) \
  X(character_state, true, O(footing), O(ground), O(stuck), O(foot), O(foot_at), O(velocity), O(normal)) \
  X(vehicle_state, true, O(engine_spin), O(clutch_load)) \
  X(wheel_state, true, O(spin), O(angle), O(steered), O(length), O(slip), O(contact_body), O(contact_point), \
    O(contact_normal), O(load), O(along), O(across)) \
  X(joint_load_state, true, O(force), O(torque)) \
  X(coupling_state, true, O(load))

#define ISO_C_COMMON_CHECKS(X) \
  X(filter, Filter, false, O(category), O(mask), O(group)) \
  X(query_filter, CQueryFilter, false, O(mask), O(sensors), O(back_faces), O(ignore), O(group), O(start_inside), \
    O(per), O(ignore_all_count), O(ignore_all), O(ignore_kinds_count), O(reserved), O(ignore_kinds)) \
  X(overlap_hit, OverlapHit, false, O(body), O(child), O(triangle), O(material)) \
  X(body_pair, ContactEnd, false, O(a), O(b), O(child_a), O(child_b)) \
  X(sensor_event, SensorEvent, false, O(sensor), O(other), O(sensor_child), O(other_child)) \
  X(render_pose, RenderPose, false, O(body), O(position), O(orientation)) \
  X(step_report, StepReport, true, O(clamped_speed), O(clamped_force), O(clamped_position), O(stopped), O(crowded), \
    O(cut_compounds), O(unsolved)) \
  X(world_counts, WorldCounts, true, O(bodies), O(static_bodies), O(awake), O(asleep), O(contacts), O(points), \
    O(joints), O(shapes)) \
  X(break_report, BreakReport, true, O(broken), O(pieces), O(whole), O(expired)) \
  X(fault_report, CFaultReport, true, O(status), O(reserved), O(command), O(field), O(expected)) \
  X(height_patch, CHeightPatch, true, O(column), O(row), O(columns), O(rows), O(heights), O(materials)) \
  X(height_grid, HeightGrid, true, O(exponent), O(height_shift), O(columns), O(rows), O(pitch)) \
  X(height_sheet, CHeightSheet, true, O(columns), O(rows), O(pitch), O(heights)) \
  X(triangles, CTriangles, true, O(point_count), O(triangle_count), O(points), O(vertices)) \
  X(surface_materials, CSurfaceMaterials, true, O(count), O(table_count), O(numbers), O(table)) \
  X(replay_info, CReplayInfo, true, O(behaviour), O(frames), O(start_hash), O(first_frame), O(keyframes), O(file), \
    O(hz), O(substeps), O(has_state), O(scalar), O(scene), O(world), O(engine)) \
  X(replay_result, CReplayResult, true, O(outcome), O(where), O(frames), O(expected), O(actual), O(offset), O(scalar), \
    O(scene), O(lanes), O(text)) \
  X(selfcheck_result, CSelfcheckResult, true, O(sound), O(engine), O(recordings), O(failed), O(frames), O(text))
