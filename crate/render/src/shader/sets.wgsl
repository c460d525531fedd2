@fragment
fn fs_fireside(v: TheatreOut) -> @location(0) vec4<f32> { return vec4<f32>(1.0); }
@fragment
fn fs_garden(v: TheatreOut) -> @location(0) vec4<f32> { return vec4<f32>(1.0); }
@fragment
fn fs_night(v: TheatreOut) -> @location(0) vec4<f32> { return vec4<f32>(1.0); }
@fragment
fn fs_school(v: TheatreOut) -> @location(0) vec4<f32> { return vec4<f32>(1.0); }
