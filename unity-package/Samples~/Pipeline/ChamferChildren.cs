using System.Collections.Generic;
using System.Threading;
using System.Threading.Tasks;
using Chamfer;
using UnityEngine;

/// <summary>
/// Chamfers the meshes below this object when the scene starts, without holding up a frame, and frees them when it ends.
/// </summary>
public sealed class ChamferChildren : MonoBehaviour
{
    [SerializeField] private ChamferSettings settings = ChamferSettings.Default;

    private readonly List<Mesh> made = new List<Mesh>();
    private readonly CancellationTokenSource end = new CancellationTokenSource();

    private async void Start()
    {
        foreach (var filter in GetComponentsInChildren<MeshFilter>())
        {
            try { await Chamfer(filter); }
            catch (System.OperationCanceledException) { return; }
            catch (ChamferException exception) { Debug.LogWarning(exception.Message, filter); }
        }
    }

    private async Task Chamfer(MeshFilter filter)
    {
        if (filter == null || filter.sharedMesh == null) { return; }
        var result = await MeshChamfer.RunAsync(filter.sharedMesh, settings, null, end.Token);
        // Unity does not free meshes by itself, and the object may be gone meanwhile.
        if (filter == null || end.IsCancellationRequested) { Destroy(result.Mesh); return; }
        made.Add(result.Mesh);
        filter.sharedMesh = result.Mesh;
        Debug.Log(filter.name + ": " + result.Report, filter);
    }

    private void OnDestroy()
    {
        end.Cancel();
        foreach (var mesh in made) { Destroy(mesh); }
    }
}
