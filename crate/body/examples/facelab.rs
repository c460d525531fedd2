use raconteur_body::face::*;
use raconteur_body::generator::{build, people::preset, write::to_glb};
use raconteur_body::skeleton::{Bone, Drive};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut params = preset(&args[1]).unwrap();
    if std::env::var_os("SYM").is_some() {
        params.head.asymmetry = 0.0;
    }
    let t0 = std::time::Instant::now();
    let built = build(&params);
    eprintln!("built {:?}", t0.elapsed());
    let figure = built.figure;
    let tissue = figure.tissue.clone().unwrap();
    let mut net = Network::new(&tissue);
    eprintln!(
        "nodes {} springs {:?} fibres {} points {} holds {} links {} columns {} lips {} pairs {} teeth {} quads {} scale {}",
        tissue.rest.len(),
        net.size(),
        tissue.fibres.len(),
        tissue.points.len(),
        tissue.attachments.len(),
        tissue.links.len(),
        tissue.columns.len(),
        tissue.lips.len(),
        tissue.pairs.len(),
        tissue.before_teeth.len(),
        tissue.quads.len(),
        tissue.scale
    );
    for a in &tissue.arches {
        eprintln!("arch {:?} rows {} cols {}", a.origin, a.rows, a.columns);
    }
    let bound: usize = figure
        .meshes
        .iter()
        .filter_map(|m| m.binding.as_ref())
        .map(|b| b.vertices.len())
        .sum();
    let w: usize = figure
        .meshes
        .iter()
        .filter_map(|m| m.binding.as_ref())
        .map(|b| b.nodes.len())
        .sum();
    eprintln!("bound {bound} weights {w}");
    let rest = FaceControls::default();
    net.reset(&tissue, &rest, &rest);
    let t0 = std::time::Instant::now();
    for _ in 0..600 {
        net.step(&tissue, &rest);
    }
    eprintln!(
        "step {:?} rest drift fastest {} stretched {} depths {:?}",
        t0.elapsed() / 600,
        net.fastest_m_per_s(),
        net.most_stretched(),
        net.depths()
    );
    for spec in args[2..].iter() {
        let (name, what) = spec.split_once(':').unwrap();
        let mut c = FaceControls::default();
        for part in what.split(',').filter(|p| !p.is_empty()) {
            let (k, v) = part.split_once('=').unwrap();
            let v: f64 = v.parse().unwrap();
            match k {
                "jaw" => c.jaw.pitch_rad = v,
                "yaw" => c.jaw.yaw_rad = v,
                "fwd" => c.jaw.forward_m = v,
                "prot" => c.protrusion = [v; 2],
                "pu" => c.protrusion[0] = v,
                "pl" => c.protrusion[1] = v,
                "seal" => c.seal = v,
                "bite" => c.bite = v,
                _ => {
                    let mut hit = false;
                    for m in Muscle::all() {
                        if m.name() == k
                            || m.name() == format!("{k}Left")
                            || m.name() == format!("{k}Right")
                            || m.name() == format!("{k}Upper")
                            || m.name() == format!("{k}Lower")
                        {
                            c.contraction[m.index()] = v;
                            hit = true;
                        }
                    }
                    assert!(hit, "{k}");
                }
            }
        }
        net.reset(&tissue, &rest, &rest);
        let mut settle = 0;
        for i in 0..240 {
            net.step(&tissue, &c);
            if net.fastest_m_per_s() > 0.001 {
                settle = i;
            }
        }
        let mut nodes = vec![NodeState::default(); tissue.rest.len()];
        net.write(&tissue, 1.0, &mut nodes);
        let gap = |k: usize| {
            let [a, b] = tissue.columns[k].contact.map(usize::from);
            let (p, q) = (net.place(a), net.place(b));
            let r = [0, 1, 2].map(|i| tissue.rest[a][i] - tissue.rest[b][i]);
            [0, 1, 2].map(|i| ((p[i] - q[i] - r[i]) * 1e5).round() / 100.0)
        };
        eprintln!(
            "{name}: settled {settle} stretched {:.2} depths {:?} gaps {:?} {:?} {:?}",
            net.most_stretched(),
            net.depths(),
            gap(0),
            gap(4),
            gap(8)
        );
        let [_, b] = tissue.columns[0].contact.map(usize::from);
        let e = tissue.columns[0].edge;
        let p = net.place(b);
        eprintln!(
            "   lower lip to teeth {:?} mm",
            [0, 1, 2].map(|i| ((p[i] - e[i]) * 1e5).round() / 100.0)
        );
        let mut out = figure.clone();
        let (skull, chin) = {
            let j = out.skeleton.joints();
            let f = |b| j.iter().position(|x| x.drive == Drive::Bone(b)).unwrap() as u16;
            (f(Bone::Skull), f(Bone::Chin))
        };
        // teeth etc. of the jaw
        let s = c.jaw.pitch_rad;
        let h = tissue.hinge.map(f64::from);
        for m in &mut out.meshes {
            let n = m.positions.len();
            let is_bound = m.binding.clone();
            if let Some(b) = &is_bound {
                for (r, &v) in b.vertices.iter().enumerate() {
                    let v = v as usize;
                    for k in b.starts[r] as usize..b.starts[r + 1] as usize {
                        let node = &nodes[usize::from(b.nodes[k])];
                        for c in 0..3 {
                            m.positions[v][c] += node.displacement[c] * b.weights[k];
                            m.normals[v][c] += node.normal_delta[c] * b.weights[k];
                        }
                    }
                    let l = m.normals[v].iter().map(|x| x * x).sum::<f32>().sqrt();
                    for x in &mut m.normals[v] {
                        *x /= l;
                    }
                    for j in &mut m.joints[v] {
                        if *j == chin {
                            *j = skull;
                        }
                    }
                }
            } else {
                for v in 0..n {
                    let w: f32 = (0..4)
                        .filter(|k| m.joints[v][*k] == chin)
                        .map(|k| m.weights[v][k])
                        .sum();
                    if w > 0.0 {
                        let p = m.positions[v].map(f64::from);
                        let (y, z) = (p[1] - h[1], p[2] - h[2]);
                        let q = [
                            p[0],
                            h[1] + y * s.cos() - z * s.sin(),
                            h[2] + y * s.sin() + z * s.cos() + c.jaw.forward_m,
                        ];
                        for k in 0..3 {
                            m.positions[v][k] += ((q[k] - p[k]) as f32) * w;
                        }
                        for j in &mut m.joints[v] {
                            if *j == chin {
                                *j = skull;
                            }
                        }
                    }
                }
            }
            m.morphs.clear();
            m.binding = None;
        }
        out.morph_names.clear();
        std::fs::write(format!("{name}.glb"), to_glb(&out)).unwrap();
    }
}
