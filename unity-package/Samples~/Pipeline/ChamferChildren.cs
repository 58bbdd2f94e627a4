using System.Threading.Tasks;
using Chamfer;
using UnityEngine;

/// <summary>Chamfers the meshes below this object when the scene starts, without holding up a frame.</summary>
public sealed class ChamferChildren : MonoBehaviour
{
    [SerializeField] private ChamferSettings settings = ChamferSettings.Default;

    private async void Start()
    {
        foreach (var filter in GetComponentsInChildren<MeshFilter>())
        {
            try { await Chamfer(filter); }
            catch (ChamferException exception) { Debug.LogWarning(exception.Message, filter); }
        }
    }

    private async Task Chamfer(MeshFilter filter)
    {
        if (filter.sharedMesh == null) { return; }
        var result = await MeshChamfer.RunAsync(filter.sharedMesh, settings);
        if (filter == null) { Destroy(result.Mesh); return; }
        filter.sharedMesh = result.Mesh;
        Debug.Log(filter.name + ": " + result.Report, filter);
    }
}
