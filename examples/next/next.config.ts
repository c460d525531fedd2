import type { NextConfig } from 'next';

// Else the lock file of a folder further up makes that the root of the application.
const config: NextConfig = { turbopack: { root: import.meta.dirname } };

export default config;
