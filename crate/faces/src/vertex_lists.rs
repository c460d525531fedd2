//! Lists of numbers by vertex, stored one behind the other.

/// Lists of numbers, one for each vertex, in compact storage.
#[derive(Clone, Debug)]
pub(crate) struct VertexLists {
    /// Start of each vertex's entries in `all`; one entry more than there are vertices.
    starts: Vec<u32>,
    all: Vec<u32>,
}

impl VertexLists {
    /// Collects the indices of items by the vertices that they use.
    pub(crate) fn collect<'v>(
        vertices: usize,
        things: impl Iterator<Item = &'v [u32]> + Clone,
    ) -> Self {
        let mut starts = vec![0; vertices + 1];
        for v in things.clone().flatten() {
            starts[*v as usize + 1] += 1;
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut all = vec![0; starts[vertices] as usize];
        for (number, own) in (0u32..).zip(things) {
            for v in own {
                let place = &mut next[*v as usize];
                all[*place as usize] = number;
                *place += 1;
            }
        }
        Self { starts, all }
    }

    /// Returns the entries of any of these vertices, sorted and without duplicates.
    pub(crate) fn about(&self, vertices: &[u32]) -> Vec<u32> {
        let own = |v: &u32| {
            let [from, to] = [0, 1].map(|k| self.starts[*v as usize + k] as usize);
            &self.all[from..to]
        };
        let mut found: Vec<u32> = vertices.iter().flat_map(own).copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}
